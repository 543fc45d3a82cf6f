#!/usr/bin/python3
"""speed.py --tyglab NATIVE --page FOLDER [--rounds N] [--json F.json]: processor time for a particle and step of Verlet in float, 128 x 128,
one thread: the desktop's program with its best vectors, with AVX2 and with 128 bits, and the page's under Node.

Each time is that of a long run less that of a short one, so that starting counts nowhere; the runs of all programs take
turns, and the least time of each is kept, since other work on the machine only ever adds.
"""
import argparse
import datetime
import json
import os
import pathlib
import resource
import subprocess
import tempfile

SIDE, SHORT, LONG = 128, 1500, 7500
# Loaded first: Highway, the library of vectors, then passes over what is disabled. Names are its targets of x86-64.
LIMIT = """#include <hwy/targets.h>
__attribute__((constructor)) static void limit() { hwy::DisableTargets(%s); }
"""
WIDER = {"AVX2": "HWY_AVX3 | HWY_AVX3_DL", "128 bits": "HWY_AVX3 | HWY_AVX3_DL | HWY_AVX2"}


def processor_time(command, environment):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tyglab", required=True)
    parser.add_argument("--page", required=True)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=pathlib.Path, help="for docs/make_benchmarks")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        run = ["run", "hanging", "--set", f"rows={SIDE}", "--set", f"columns={SIDE}", "--engine", "cpu", "--precision", "float",
               "--integrator", "verlet", "--threads", "1", "--dt", "0.0001", "--steps"]
        script = pathlib.Path(__file__).resolve().parent / "program.js"
        programs = {"best vectors": ([args.tyglab], {})}
        for name, disabled in WIDER.items():
            library = pathlib.Path(folder) / f"{name.replace(' ', '_')}.so"  # a space ends a name there
            subprocess.run(["g++", "-shared", "-fPIC", "-x", "c++", "-", "-o", library, "-lhwy"], input=LIMIT % disabled,
                           text=True, check=True)
            programs[name] = ([args.tyglab], {"LD_PRELOAD": str(library)})
        programs["page, Node"] = (["node", script, args.page, folder], {})
        least = {}
        for _ in range(args.rounds):
            for name, (command, environment) in programs.items():
                for steps in (SHORT, LONG):
                    time = processor_time([*command, *run, str(steps)], environment)
                    least[name, steps] = min(time, least.get((name, steps), time))
    times = {name: (least[name, LONG] - least[name, SHORT]) / ((LONG - SHORT) * SIDE * SIDE) * 1e9 for name in programs}
    for name, time in times.items():
        print(f"{name:14} {time:6.2f} ns  {time / times['AVX2']:5.2f} of AVX2")
    if args.json:
        node = subprocess.run(["node", "--version"], check=True, capture_output=True, text=True).stdout.strip()
        runs = [{"program": name, "ns_per_particle_step": time, "over_avx2": time / times["AVX2"]} for name, time in times.items()]
        args.json.write_text(json.dumps({"side": SIDE, "date": str(datetime.date.today()), "node": node, "runs": runs}))


main()
