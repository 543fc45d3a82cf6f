#!/usr/bin/python3
"""speed.py --tyglab NATIVE --page FOLDER [--windows FOLDER] [--rounds N] [--json F.json]: time for a particle and step of
Verlet in float, 128 x 128: the desktop's program with its best vectors, with AVX2 and with 128 bits, the page's programs under
Node, and the program for Windows under Wine. Processor time of one thread, and for the page with two threads real time.

Also what a browser loads before the page's first frame, compressed, and how long after the last byte Chromium shows it, on this
processor, which also draws: the median of as many starts, each with nothing kept; and the processor time that the page itself
takes for a frame beside studies. Needs the packages of [page] in
cmake/packages.txt, which tests/web/run installs.

Each time is that of a long run less that of a short one, so that starting counts nowhere; the runs of all programs take
turns, and the least time of each is kept, since other work on the machine only ever adds.
"""
import argparse
import datetime
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from browser import Browser
from instruction_sets import WIDER, limited_to
from test_page import CLOTH_OF_STUDIES, downloaded, frames_beside_studies, opened, served

SIDE, SHORT, LONG = 128, 1500, 7500


def times_of(command, environment):
    """Processor time and real time, s."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, time.monotonic() - start


def start_times(page, threads, rounds):
    """From the last byte to the first frame, s."""
    times = []
    for _ in range(rounds):
        with served(page, threads) as address, Browser() as browser:
            shown = browser.page(f"{address}/#hanging")
            shown.started()
            loaded = shown.ask("""Math.max(...performance.getEntriesByType('resource')
                .filter((file) => /tyglab(-threads)?\\.(js|wasm)$|data\\.bin$/.test(file.name)).map((file) => file.responseEnd))""")
            drawn = shown.ask("performance.getEntriesByName('tyglab first frame')[0].startTime")
            times.append((drawn - loaded) / 1000)
    return times


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tyglab", required=True)
    parser.add_argument("--page", required=True)
    parser.add_argument("--windows", type=pathlib.Path, help="the folder that cmake/windows/build makes")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=pathlib.Path, help="for docs/make_benchmarks")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        run = ["run", "hanging", "--set", f"rows={SIDE}", "--set", f"columns={SIDE}", "--engine", "cpu", "--precision", "float",
               "--integrator", "verlet", "--dt", "0.0001"]
        script = pathlib.Path(__file__).resolve().parent / "program.js"
        programs = {"best vectors": ([args.tyglab], {}, 1)}
        for name in WIDER:
            programs[name] = ([args.tyglab], limited_to(name, folder), 1)
        node = ["node", script, args.page, folder]
        programs["page, Node"] = (node, {}, 1)
        for threads, used in [(1, "one used"), (2, "two used, real time")]:
            programs[f"page with threads, {used}"] = (node, {"TYGLAB_PROGRAM": "tyglab-threads"}, threads)
        wine = {"WINEPREFIX": f"{folder}/wine", "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
        if args.windows:
            for start in (["wineboot", "--init"], ["wineserver", "-w"], ["wineserver", "-p"]):
                subprocess.run(start, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **wine})
            programs["for Windows, best vectors, Wine"] = (["wine", args.windows / "tyglab.exe"], wine, 1)
        least = {}
        for _ in range(args.rounds):
            for name, (command, environment, threads) in programs.items():
                for steps in (SHORT, LONG):
                    processor, real = times_of([*command, *run, "--threads", str(threads), "--steps", str(steps)], environment)
                    taken = processor if threads == 1 else real
                    least[name, steps] = min(taken, least.get((name, steps), taken))
        if args.windows:
            subprocess.run(["wineserver", "-k"], check=False, env={**os.environ, **wine})
    times = {name: (least[name, LONG] - least[name, SHORT]) / ((LONG - SHORT) * SIDE * SIDE) * 1e9 for name in programs}
    for name, taken in times.items():
        print(f"{name:34} {taken:6.2f} ns  {taken / times['AVX2']:5.2f} of AVX2")
    starts = []
    for program, threads in [("tyglab", False), ("tyglab-threads", True)]:
        size = downloaded(pathlib.Path(args.page), program)
        start = statistics.median(start_times(args.page, threads, args.rounds))
        starts.append({"program": "page with threads" if threads else "page", "bytes": size, "first_frame_s": start})
        print(f"{starts[-1]['program']:34} {size / 1e6:6.2f} MB before the first frame, {start:.2f} s after the last byte")
    with served(args.page) as address, Browser() as browser:
        shown = opened(browser, f"{address}/?report{CLOTH_OF_STUDIES}", width=800, height=600)
        frames = [{"beside": what, "median_ms": statistics.median(computed), "longest_task_ms": longest}
                  for what, _, computed, longest in frames_beside_studies(shown)]
    for row in frames:
        print(f"{row['beside']:52} {row['median_ms']:5.1f} ms of the page's own for a frame, {row['longest_task_ms']:4.0f} for its longest task")
    if args.json:
        node = subprocess.run(["node", "--version"], check=True, capture_output=True, text=True).stdout.strip()
        runs = [{"program": name, "ns_per_particle_step": taken, "over_avx2": taken / times["AVX2"]} for name, taken in times.items()]
        args.json.write_text(json.dumps({"side": SIDE, "date": str(datetime.date.today()), "node": node, "runs": runs,
                                         "starts": starts, "frames": frames}))


main()
