#!/usr/bin/python3
"""test_states.py --tyglab NATIVE --page FOLDER: the page's program, under Node, against the desktop's: presets, methods,
precisions, links and exit codes.

Springs that buckle make a motion chaotic, so bounds hold for a tenth of a second: single precision rounds at 6e-8, and
its roots differ (core/simd/simd-inl.h); double precision differs by the order of a few sums and by fused operations.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

SECONDS = "0.1"
BOUNDS = {"float": 2e-5, "double": 1e-12}  # m, of any coordinate; measured: 9.8e-6 and 5.6e-14
# A flat cloth of stiff threads is compressed where springs only pull, so its threads buckle within their plane, and the
# last bit grows to 1e-6 m and no farther: two desktop runs of `cusick`, of which one starts a bit to the side, differ by
# 3e-16 m after 1 ms, 4e-16 m after 20 ms, 3e-13 m after 40 ms and 7e-8 m after 100 ms. Double precision follows them for
# a shorter time. The shocks with which `twist` begins do that in float too: two desktop runs, of which one begins 1e-7 m/s
# faster, differ by 4e-7 m after 20 ms and 5e-3 m after 100 ms.
BUCKLING, BUCKLING_SECONDS = {"cusick", "fabric_paper", "fabric_trousers", "twist"}, "0.02"
SHOCKED = {"twist"}
ROOT = pathlib.Path(__file__).resolve().parents[2]
PRESETS = sorted(file.stem for file in (ROOT / "app" / "presets").glob("*.json"))
# The cloth of `table` within 3 cm above each shape, which it meets within the time that is compared. `global` orders impacts
# by time, and the last bit decides which 32 of many simultaneous ones split the step, so that it meets 36 particles: of 144,
# which two desktop runs at tilts 1e-11 degrees apart lead 7e-6 m apart on the box, of these 5e-14 m.
FALLING = ["table", "--set", "rows=12", "--set", "columns=12", "--set", "x_0=[0,0.33,-0.165]", "--set", "tilt_deg=7",
           "--set", "v_0=[0,-0.5,0]"]
BODIES = {
    "sphere": {"shape": "sphere", "c": [0, 0.1, 0], "r": 0.2, "velocity": [0.3, 0, 0.1]},
    "plane": {"shape": "plane", "y": 0.3, "turn": [0, 0, 0.5], "velocity": [0, 0.2, 0]},
    "box": {"shape": "box", "c": [0, 0.2, 0], "size": [0.22, 0.2, 0.25], "spin": [0, 6, 0]},
    "capsule": {"shape": "capsule", "c": [0, 0.2, 0], "r": 0.1, "length": 0.1, "turn": [0, 20, 90], "spin": [3, 0, 0]},
    "cylinder": {"shape": "cylinder", "c": [0, 0.25, 0], "r": 0.1, "length": 0.1,
                 "path": [[0, 0, 0.25, 0], [0.03, 0, 0.25, 0], [0.08, 0.02, 0.26, 0]]},
}


def positions(file):
    with open(file, encoding="utf-8") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [[float(row[axis]) for axis in "xyz"] for row in rows]


class Programs:
    def __init__(self, tyglab, page, scratch):
        self.tyglab, self.page, self.scratch = tyglab, page, scratch

    def native(self, *words):
        return subprocess.run([self.tyglab, *words], cwd=self.scratch, capture_output=True, text=True, check=False)

    def web(self, *words, program="tyglab"):
        script = pathlib.Path(__file__).parent / "program.js"
        return subprocess.run(["node", script, self.page, self.scratch, *words], capture_output=True, text=True, check=False,
                              env={**os.environ, "TYGLAB_PROGRAM": program})

    def compare(self, name, *words):
        """The largest difference of a coordinate between the two, m."""
        found = []
        for way in (self.native, self.web):
            file = self.scratch / "state.csv"
            file.unlink(missing_ok=True)
            ended = way("run", *words, "--state", "state.csv")
            if ended.returncode not in (0, 4) or not file.exists():
                sys.exit(f"{name}: {way.__name__} ended with {ended.returncode}: {ended.stderr}")
            found.append((ended.returncode, positions(file)))
        (code, ours), (other_code, theirs) = found
        if code != other_code or len(ours) != len(theirs):
            sys.exit(f"{name}: exit codes {code} and {other_code}, {len(ours)} and {len(theirs)} particles")
        return max(abs(a - b) for p, q in zip(ours, theirs) for a, b in zip(p, q)), code


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tyglab", required=True)
    parser.add_argument("--page", required=True)
    args = parser.parse_args()
    bad, worst, checks = [], {"float": 0.0, "double": 0.0}, 0
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(str(pathlib.Path(args.tyglab).resolve()), args.page, pathlib.Path(folder))

        def check(name, good, said=""):
            nonlocal checks
            checks += 1
            if not good:
                bad.append(name)
                print(f"FAILED: {name}: {said}")

        # Scenes at sizes that a test has time for.
        for preset in PRESETS:
            small = ["--set", "rows=16", "--set", "columns=16"] if preset in ("hanging", "denim", "rubber_mat", "flag", "sphere", "taut_sheet", "explodes") else []
            for precision, bound in BOUNDS.items():
                seconds = BUCKLING_SECONDS if preset in SHOCKED or (precision == "double" and preset in BUCKLING) else SECONDS
                difference, code = programs.compare(f"{preset} {precision}", preset, "--seconds", seconds, "--precision", precision,
                                                    "--engine", "cpu", *small)
                if code == 4:
                    continue  # what has diverged is noise
                worst[precision] = max(worst[precision], difference)
                check(f"{preset} {precision}", difference <= bound, f"differs by {difference:.3g} m")
        for shape, body in BODIES.items():
            for contact in ("step", "local", "global"):
                for precision, bound in BOUNDS.items():
                    name = f"{shape}, contact {contact}, {precision}"
                    few = ["--set", "rows=6", "--set", "columns=6"] if contact == "global" else []
                    difference, _ = programs.compare(name, *FALLING, *few, "--set", f"contact={contact}", "--precision", precision, "--engine", "cpu",
                                                     "--set", f"bodies={json.dumps([{'friction': 0.5, **body}])}", "--seconds", SECONDS)
                    worst[precision] = max(worst[precision], difference)
                    check(name, difference <= bound, f"differs by {difference:.3g} m")
        listed = programs.native("run", "hanging", "--steps", "1", "--integrator", "none").stderr
        methods = [word.strip(" .\n") for word in listed.partition("Known: ")[2].split(",") if word.strip()]
        check("the list of methods", len(methods) > 9, listed)
        for method in methods:
            for precision, bound in BOUNDS.items():
                # What is unstable at every dt amplifies the last bit, so it is followed for a shorter time.
                span = ["0.02", "--dt", "0.0001"] if method in ("euler", "improved_euler") else [SECONDS, "--dt", "0.0005"]
                difference, _ = programs.compare(f"{method} {precision}", "hanging", "--integrator", method, "--precision", precision,
                                                 "--set", "rows=12", "--set", "columns=12", "--seconds", *span)
                worst[precision] = max(worst[precision], difference)
                check(f"{method} {precision}", difference <= bound, f"differs by {difference:.3g} m")
        found = programs.web("run", "hanging", "--set", "rows=8", "--set", "columns=8", "--seconds", "0.05", "--tolerance", "1e-3").stderr
        check("costs of methods", "CPU time" in found and "takes 0 s" not in found and "NaN" not in found, found)
        for method in methods:
            words = ["run", "hanging", "--integrator", method, "--engine", "cpu", "--set", "rows=64", "--set", "columns=64", "--dt",
                     "0.0001", "--steps", "20", "--state", "state.csv"]
            states = []
            for program, threads in [("tyglab", "1"), ("tyglab-threads", "1"), ("tyglab-threads", "3")]:
                ended = programs.web(*words, "--threads", threads, program=program)
                states.append(ended.stderr if ended.returncode else positions(programs.scratch / "state.csv"))
            check(f"{method} by threads", states[0] == states[1] == states[2] and len(states[0]) == 64 * 64, f"{states[2][:1]}")
        ended = programs.web("verify", "--threads", "1", "--json", "verify.json")
        cases = json.loads((programs.scratch / "verify.json").read_text())["cases"]
        failed = [case["name"] for case in cases if not case["ok"]]
        check("the gallery of exact answers", ended.returncode == 0 and len(cases) > 40 and not failed, f"{failed} {ended.stderr}")
        link = "https://example.org/lab/#hanging&k_s=80&W=%5B0,0,0.001%5D"
        difference, _ = programs.compare("a link", link, "--seconds", SECONDS)
        check("a link", difference <= BOUNDS["float"], f"differs by {difference:.3g} m")
        for words, code in [(["run", "#nothing"], 3), (["run", "hanging", "--set", "k_s=x"], 2), (["render", "hanging"], 2),
                            *((["run", "hanging", "--steps", "1", "--set", f"k_s={number}"], code) for number, code in
                              [("1e999", 2), ("1e-999", 2), (".5", 0), ("5.", 0), ("0", 0), ("0x10", 2), ("+5", 2), ("inf", 2), ("1e", 2)])]:
            ours, theirs = programs.native(*words).returncode, programs.web(*words).returncode
            check(" ".join(words), ours == theirs == code, f"exit codes {ours} and {theirs}")
    print(f"{checks - len(bad)} of {checks} passed; largest differences: float {worst['float']:.2g} m, double {worst['double']:.2g} m")
    sys.exit(1 if bad else 0)


main()
