"""The Python module: the steps of `tyglab run` to the last bit, arrays that follow, errors that say what is wrong."""

import argparse
import ast
import copy
import csv
import inspect
import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
import zlib

import numpy as np
import tyglab

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = None


def state_of_run(preset, steps, folder, *settings):
    """Positions and velocities that `tyglab run` ends with."""
    file = pathlib.Path(folder) / "state.csv"
    options = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([PROGRAM, "run", preset, "--steps", str(steps), "--state", file, *options], check=True,
                   capture_output=True)
    with open(file) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [{key: float(value) for key, value in row.items()} for row in rows], file.read_bytes()


class Presets(unittest.TestCase):
    def test_constants_are_read_and_set_by_their_keys(self):
        preset = tyglab.Preset(k_s=200, integrator="rk4", W=(0, 0, 0.01), pins=[[0, 0], [0, 5]])
        self.assertEqual(preset["k_s"], 200)
        self.assertEqual(preset["integrator"], "rk4")
        self.assertEqual(preset["W"], [0, 0, 0.01])
        preset["dt"] = np.float64(0.0005)
        self.assertEqual(preset["dt"], 0.0005)
        preset["W"] = np.array([0.0, 0.1, 0.0])
        self.assertEqual(preset["W"], [0, 0.1, 0])
        self.assertEqual(preset.but(m=0.001)["m"], 0.001)
        self.assertNotEqual(preset.but(m=0.001), preset)
        for key in tyglab.Preset.keys():
            if key not in ("device",):
                preset[key]
        preset["tearing.mode"] = "split"
        self.assertEqual((preset["mode"], preset["tearing.mode"]), (1, "split"))

    def test_a_cloth_that_parts(self):
        preset = tyglab.Preset(rows=9, columns=9)
        preset["tearing.mode"] = "split"
        simulation = tyglab.Simulation(preset)
        simulation.run(0.2)
        simulation.cut([(4, 3), (4, 4), (4, 5)])
        simulation.run(0.2)
        self.assertEqual(simulation.positions.shape, (9, 9, 3))
        self.assertEqual(len(simulation.copies), simulation.torn)
        self.assertGreater(simulation.torn, 0)
        site, x, v = simulation.copies[0]
        self.assertEqual(site[0], 4)
        self.assertEqual((len(x), len(v)), (3, 3))

    def test_a_wrong_one_is_named_and_changes_nothing(self):
        preset = tyglab.Preset()
        with self.assertRaisesRegex(tyglab.PresetError, "k_s.*0 and|did you mean|k_s"):
            preset["k_s"] = -1
        with self.assertRaisesRegex(tyglab.PresetError, "did you mean k_s"):
            preset["k_S"] = 1
        with self.assertRaises(tyglab.PresetError):
            tyglab.Preset(dt="fast")
        with self.assertRaises(KeyError):
            preset["k_z"]
        with self.assertRaises(ValueError):
            tyglab.Preset.load("hangin")
        self.assertEqual(preset, tyglab.Preset())

    def test_files_text_and_pickles_give_the_same_preset_back(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in tyglab.presets():
                preset = tyglab.Preset.load(name)
                self.assertEqual(tyglab.Preset.from_json(preset.to_json()), preset)
                for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                    self.assertEqual(pickle.loads(pickle.dumps(preset, protocol)), preset)
                self.assertEqual(copy.copy(preset), preset)
            file = pathlib.Path(folder) / "mine.json"
            tyglab.Preset(name="Mine", k_s=70).save(file)
            self.assertEqual(tyglab.Preset.load(str(file))["k_s"], 70)
            with self.assertRaises(OSError):
                preset.save(pathlib.Path(folder) / "none" / "mine.json")

    def test_an_object_that_was_never_made_is_refused(self):
        for kind in (tyglab.Preset, tyglab.Simulation, tyglab.Snapshot, tyglab.Divergence, tyglab.Repetition):
            unmade = kind.__new__(kind)
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                with self.assertRaises(TypeError):
                    pickle.dumps(unmade, protocol)
            for name in ("preset", "time", "where"):
                if hasattr(kind, name):
                    with self.assertRaises(TypeError):
                        getattr(unmade, name)
        with self.assertRaises(TypeError):
            tyglab.Preset.__new__(tyglab.Preset).to_json()
        with self.assertRaises(TypeError):
            tyglab.Simulation(tyglab.Preset.__new__(tyglab.Preset))


class Simulations(unittest.TestCase):
    def test_states_are_those_of_the_command_line_to_the_last_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("hanging", "flag", "sphere"):
                for settings in (("precision=double",), ("precision=float", "integrator=rk4")):
                    rows, text = state_of_run(name, 60, folder, *settings)
                    preset = tyglab.Preset.load(name)
                    for setting in settings:
                        key, value = setting.split("=")
                        preset[key] = value
                    simulation = tyglab.Simulation(preset, threads=2)
                    self.assertEqual(simulation.step(60), 60)
                    for row in rows:
                        at = simulation.positions[int(row["i"]), int(row["j"])]
                        self.assertEqual(list(at), [row["x"], row["y"], row["z"]])
                    own = pathlib.Path(folder) / "own.csv"
                    simulation.save_state(own)
                    self.assertEqual(own.read_bytes(), text)

    def test_csv_files_are_read_as_the_page_of_files_says(self):
        page = (ROOT / "docs" / "presets.md").read_text()
        reading = re.search(r"^data = numpy\.genfromtxt\((.*)\)$", page, re.MULTILINE).group(1)
        with tempfile.TemporaryDirectory() as folder:
            files = {name: str(pathlib.Path(folder) / f"{name}.csv") for name in ("state", "series", "ledger", "values")}
            # 120 steps of 1 ms end with a frame of 1/25 s, so that the last row is that of the last state.
            subprocess.run([PROGRAM, "run", "hanging", "--steps", "120", "--set", "rows=8", "--set", "columns=8",
                            *[word for name, file in files.items() for word in (f"--{name}", file)]],
                           check=True, capture_output=True)
            read = {}
            for name, file in files.items():
                read[name] = eval(f"numpy.genfromtxt({reading})".replace("forces.csv", file), {"numpy": np})
                self.assertTrue(np.isfinite(read[name].view(np.float64)).all(), name)
            self.assertEqual(read["state"].dtype.names, ("i", "j", "x", "y", "z", "vx", "vy", "vz"))
            self.assertEqual(len(read["state"]), 64)
            self.assertEqual(read["series"].size, 4)
            self.assertAlmostEqual(read["series"]["t"][-1], 0.12, delta=1e-9)
            self.assertAlmostEqual(read["series"]["y_min_m"][-1], read["state"]["y"].min(), delta=1e-6)
            self.assertEqual(read["series"]["t"][0], 0)
            self.assertIn("sum_F_N", read["series"].dtype.names)

    def test_arrays_share_the_memory_and_follow_the_steps(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=5, columns=7))
        x, v = simulation.positions, simulation.velocities
        self.assertEqual((x.shape, x.dtype, x.flags.owndata), ((5, 7, 3), np.float64, False))
        self.assertEqual(simulation.positions.ctypes.data, x.ctypes.data)
        before = x.copy()
        simulation.step(10)
        self.assertFalse(np.array_equal(x, before))
        self.assertTrue(np.array_equal(x, simulation.positions) and np.array_equal(v, simulation.velocities))
        with self.assertRaises(ValueError):
            x[0, 0, 0] = 1
        simulation.change(rows=9)
        self.assertEqual(simulation.positions.shape, (9, 7, 3))
        kept = x.copy()
        simulation.step(3)
        self.assertTrue(np.array_equal(x, kept))
        del simulation
        self.assertTrue(np.array_equal(x, kept))

    def test_energy_and_forces_add_up(self):
        simulation = tyglab.Simulation(tyglab.Preset.load("one_weight"))
        simulation.run(0.2)
        r = simulation.particle(0, 0)
        np.testing.assert_allclose(r["F"], r["F_int"] + r["F_ext"], atol=1e-12)
        energy = simulation.energy
        self.assertAlmostEqual(energy["total"], sum(energy[k] for k in ("kinetic", "stretch", "bending", "gravity")))
        y, v = tyglab.exact_motion(simulation.preset, simulation.time)
        self.assertAlmostEqual(r["x"][1], float(y), delta=1e-3)

    def test_hand_knife_pins_and_going_back(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=8, columns=8, integrator="rk4"))
        simulation.grab(7, 3)
        self.assertEqual(simulation.held, (7, 3))
        goal = simulation.positions[7, 3] + [0.05, 0, 0.05]
        simulation.move_hand(goal, 50)
        simulation.step(50)
        np.testing.assert_allclose(simulation.positions[7, 3], goal, atol=1e-6)
        simulation.release()
        then, x = simulation.snapshot(), simulation.positions.copy()
        simulation.cut([(4, 2), (4, 3)])
        self.assertGreater(simulation.torn, 0)
        simulation.pin(7, 7)
        simulation.step(20)
        simulation.restore(then)
        self.assertTrue(np.array_equal(simulation.positions, x))
        self.assertEqual(simulation.torn, 0)
        simulation.load(x, np.zeros_like(x))
        self.assertEqual(np.abs(simulation.velocities).max(), 0)
        simulation.restart()
        self.assertEqual((simulation.steps, simulation.time), (0, 0))
        for wrong in (lambda: simulation.grab(0, 0), lambda: simulation.move_hand([0, 0, 0]),
                      lambda: simulation.load(x[:2], x), lambda: simulation.step(-1), lambda: simulation.run(-1),
                      lambda: simulation.load(x * np.nan, x), lambda: tyglab.Simulation(threads=0)):
            self.assertRaises(ValueError, wrong)
        for wrong in (lambda: simulation.particle(8, 0), lambda: simulation.pin(-1, 0),
                      lambda: simulation.move_body(0, [0, 0, 0])):
            self.assertRaises(IndexError, wrong)

    def test_a_divergence_is_an_exception_that_says_when_where_and_why(self):
        simulation = tyglab.Simulation(tyglab.Preset.load("explodes"))
        with self.assertRaisesRegex(tyglab.Diverged, "diverged at t = ") as caught:
            simulation.run(2)
        divergence = caught.exception.divergence
        self.assertEqual(divergence.step, simulation.divergence.step)
        self.assertEqual(simulation.steps, divergence.step - 1)
        self.assertTrue(np.isfinite(simulation.positions).all())
        self.assertRaises(tyglab.Diverged, simulation.step)
        simulation.restart()
        self.assertIsNone(simulation.divergence)
        simulation.step()

    def test_the_ledger_closes(self):
        simulation = tyglab.Simulation(tyglab.Preset(precision="double", dt=0.0002, rows=8, columns=8))
        self.assertIsNone(simulation.ledger)
        simulation.enable_ledger()
        simulation.run(0.2)
        ledger = simulation.ledger
        works = sum(ledger[k] for k in ("damping", "contact", "tearing", "wind", "air", "hand", "edits"))
        self.assertAlmostEqual(ledger["total"], ledger["start"] + works + ledger["unexplained"], places=12)

    def test_solves_are_counted_and_those_that_missed(self):
        stiff = dict(k_s=1e6, dt=0.02, rows=16, columns=16, iterations=2)
        simulation = tyglab.Simulation(tyglab.Preset(integrator="vbd", **stiff))
        simulation.step(3)
        self.assertEqual(simulation.solves["newton_steps"], 6)
        self.assertEqual(simulation.solves["unconverged"], 3)
        self.assertGreater(simulation.solves["worst_residual"], 1e-4)
        self.assertIsNone(tyglab.Simulation(tyglab.Preset(integrator="verlet")).solves)
        for side, products, missed in ((8, 0, 0), (130, 2000, 2)):  # a small matrix is factorized, a large one is not
            damped = tyglab.Simulation(tyglab.Preset(integrator="damped_verlet", k_d=1e6, rows=side, columns=side))
            damped.step(2)
            self.assertEqual(damped.solves["linear_steps"], products)
            self.assertEqual(damped.solves["unconverged"], missed)

    def test_a_precision_that_is_too_coarse_is_warned_of_in_the_words_of_the_command_line(self):
        stiff = tyglab.Preset.load("hanging").but(rows=10, columns=9, k_b=0, k_s=1e7, dt=0.02, integrator="tr_bdf2")
        with self.assertWarns(UserWarning) as said:
            tyglab.Simulation(stiff)
        self.assertEqual(said.filename, __file__)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "stiff.json")
            stiff.save(file)
            told = subprocess.run([PROGRAM, "run", file, "--steps", "1"], capture_output=True, text=True, check=True)
        self.assertEqual(told.stderr.splitlines()[0], f"tyglab: {said.warning}")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tyglab.Simulation(stiff.but(precision="double"))
            with self.assertRaises(UserWarning):
                tyglab.Simulation(stiff)

    def test_a_step_can_be_limited_in_time(self):
        # Stiffer in float, and a pass leaves no more than rounding does: then nothing is missing.
        for precision, k_s in (("float", 1e4), ("double", 1e4), ("double", 1e6)):
            with self.subTest(precision=precision, k_s=k_s):
                simulation = tyglab.Simulation(tyglab.Preset(integrator="vbd", precision=precision, k_s=k_s, dt=0.02,
                                                             rows=16, columns=16))
                simulation.limit_steps(1e-12)
                simulation.step(3)
                self.assertEqual(simulation.solves["ended_early"], 3)
                simulation.limit_steps(0)
                simulation.step(1)
                self.assertEqual(simulation.solves["ended_early"], 3)
        for wrong in (-1, float("nan"), float("inf")):
            with self.assertRaises(ValueError):
                simulation.limit_steps(wrong)

    def test_other_threads_go_on_and_may_not_interfere(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=200, columns=200, precision="double"))
        worker = threading.Thread(target=lambda: simulation.step(300))
        worker.start()
        refused = False
        while worker.is_alive() and not refused:
            try:
                simulation.energy
            except RuntimeError as error:
                refused = "Another thread" in str(error)
        worker.join()
        self.assertTrue(refused)
        self.assertEqual(simulation.steps, 300)

    def test_a_forked_process_goes_on_with_the_same_steps(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=200, columns=200), threads=2)
        simulation.step(5)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "state.csv"
            child = os.fork()
            if child == 0:
                try:
                    simulation.step(5)
                    simulation.save_state(file)
                    del simulation
                finally:
                    os._exit(0)
            give_up = time.monotonic() + 60
            while os.waitpid(child, os.WNOHANG) == (0, 0):
                if time.monotonic() > give_up:
                    os.kill(child, signal.SIGKILL)
                    give_up = float("inf")
                time.sleep(0.01)
            simulation.step(5)
            simulation.save_state(pathlib.Path(folder) / "own.csv")
            self.assertEqual(file.read_text(), (pathlib.Path(folder) / "own.csv").read_text())

    def test_numbers_that_the_simulation_cannot_hold_are_refused(self):
        for precision, most in (("float", 1e38), ("double", 1e300)):
            simulation = tyglab.Simulation(tyglab.Preset(rows=4, columns=4, precision=precision))
            x, v = simulation.positions.copy(), simulation.velocities.copy()
            simulation.grab(3, 1)
            wrong = [float("nan"), float("inf")] + ([1e300, -1e39] if precision == "float" else [])
            for value in wrong:
                with self.assertRaises(ValueError):
                    simulation.move_hand([0, value, 0])
                for field in (x, v):
                    kept, field[2, 2, 0] = field[2, 2, 0], value
                    with self.assertRaises(ValueError):
                        simulation.load(x, v)
                    field[2, 2, 0] = kept
            np.testing.assert_array_equal(simulation.positions, x)
            x[2, 2, 0] = most
            simulation.load(x, v)
            self.assertTrue(np.isfinite(simulation.positions).all())

    def test_ctrl_c_ends_the_search_for_the_limit(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=300, columns=300))
        threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.dt_crit_now
        simulation.step()

    def test_ctrl_c_ends_the_steps(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=100, columns=100))
        threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(100_000_000)
        made = simulation.steps
        self.assertGreater(made, 0)
        simulation.step(2)
        self.assertEqual(simulation.steps, made + 2)


class Experiments(unittest.TestCase):
    @staticmethod
    def experiment():
        """A simulation to which everything was done that can be done, and its start."""
        start = tyglab.Preset(rows=9, columns=8, bodies=[{"c": [0, 0.4, 0], "r": 0.1}])
        simulation = tyglab.Simulation(start)
        simulation.step(300)
        simulation.mark("the hand grabs a corner")
        simulation.grab(8, 7)
        simulation.move_hand(simulation.positions[8, 7] + [0.05, 0.1, 0.02], 40)
        then = simulation.snapshot()
        simulation.step(60)
        simulation.release()
        simulation.cut([(4, 2), (4, 3)])
        simulation.change(k_s=70, W=[0, 0, 0.0001])
        simulation.pin(8, 0)
        simulation.step(250)
        simulation.restore(then)
        simulation.step(33)
        simulation.load(simulation.positions, np.zeros_like(simulation.velocities))
        simulation.move_body(0, [0, 0.45, 0.05])
        simulation.step(100)
        simulation.restart()
        simulation.change(precision="double", integrator="rk4")
        simulation.cut([(3, 5)])
        simulation.step(300)
        return simulation, start

    def test_what_was_done_is_repeated_to_the_last_bit(self):
        simulation, start = self.experiment()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "all.tyglab"
            simulation.save_experiment(file)
            self.assertEqual(tyglab.Preset.load(str(file)), start)
            for threads in (1, 2):
                found = tyglab.repeat(file, threads=threads)
                self.assertTrue(np.array_equal(found.simulation.positions, simulation.positions))
                self.assertTrue(np.array_equal(found.simulation.velocities, simulation.velocities))
                self.assertEqual(found.simulation.hash, simulation.hash)
                self.assertEqual(found.simulation.preset, simulation.preset)
                self.assertEqual((found.simulation.steps, found.simulation.time), (simulation.steps, simulation.time))
                self.assertEqual(found.simulation.torn, simulation.torn)
                self.assertEqual((found.exact, found.differs_at, found.apart), (True, None, 0))
                # The snapshot was taken at step 300: what came between it and restore() is no part of the experiment.
                self.assertEqual((found.compared, found.equal_until), (3, 733))
                self.assertIn("to the last bit", str(found))
            done = subprocess.run([PROGRAM, "run", file, "--state", pathlib.Path(folder) / "state.csv"], check=True,
                                  capture_output=True, text=True)
            self.assertIn("to the last bit, in 3 checks", done.stdout)
            simulation.save_state(pathlib.Path(folder) / "own.csv")
            self.assertEqual((pathlib.Path(folder) / "state.csv").read_bytes(),
                             (pathlib.Path(folder) / "own.csv").read_bytes())
            found.simulation.step(5)
            found.simulation.save_experiment(file)
            self.assertEqual(tyglab.repeat(file).simulation.hash, found.simulation.hash)

    def test_a_divergence_is_repeated(self):
        simulation = tyglab.Simulation(tyglab.Preset.load("explodes"))
        with self.assertRaises(tyglab.Diverged):
            simulation.run(2)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "explodes.tyglab"
            simulation.save_experiment(file)
            found = tyglab.repeat(file)
        self.assertEqual(found.simulation.divergence.step, simulation.divergence.step)
        self.assertEqual(found.simulation.hash, simulation.hash)

    def test_a_difference_is_found_and_measured(self):
        simulation, _ = self.experiment()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "changed.tyglab"
            simulation.save_experiment(file)
            packed = file.read_bytes()
            kind, size, rest = packed.split(b"\n", 2)
            text = zlib.decompress(rest)
            self.assertEqual((kind, int(size)), (b"tyglab experiment", len(text)))
            self.assertEqual(json.loads(text)["tyglab_experiment"], 1)
            self.assertIn(b'[300,"mark","the hand grabs a corner"]', text)
            file.write_bytes(text.replace(b'"cut",3,5', b'"cut",3,4'))
            found = tyglab.repeat(file)
            self.assertEqual((found.exact, found.equal_until, found.differs_at), (False, 256, 512))
            self.assertGreater(found.apart, 0)
            self.assertIn("differ at step", str(found))
            for content, why in ((b"", "is not an experiment"), (packed[:-20], "cut short"), (text[:-9], "line"),
                                 (text.replace(b'"grab"', b'"grob"'), "grob"),
                                 (text.replace(b'"tyglab_experiment": 1', b'"tyglab_experiment": 9'), "newer")):
                file.write_bytes(content)
                for read in (tyglab.repeat, lambda name: tyglab.Preset.load(str(name))):
                    with self.assertRaisesRegex(tyglab.PresetError, why):
                        read(file)
            with self.assertRaisesRegex(tyglab.PresetError, "none.tyglab"):
                tyglab.repeat(pathlib.Path(folder) / "none.tyglab")
            with self.assertRaises(OSError):
                simulation.save_experiment(pathlib.Path(folder) / "none" / "mine.tyglab")
            with self.assertRaises(ValueError):
                tyglab.repeat(file, threads=0)
        with self.assertRaises(ValueError):
            simulation.mark("x" * 1001)

    def test_ctrl_c_ends_a_repetition_also_after_a_restart(self):
        simulation = tyglab.Simulation(tyglab.Preset(rows=40, columns=40))
        simulation.step(3)
        simulation.restart()
        simulation.step(3)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "long.tyglab"
            simulation.save_experiment(file)
            text = zlib.decompress(file.read_bytes().split(b"\n", 2)[2])
            file.write_bytes(text.replace(b'"steps": 6,', b'"steps": 1000000000,'))
            threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT)).start()
            with self.assertRaises(KeyboardInterrupt):
                tyglab.repeat(file)


class Studies(unittest.TestCase):
    def test_stability_is_what_the_theory_says(self):
        one = tyglab.Preset.load("one_weight").but(k_d=0, integrator="verlet")
        limit = 2 * np.sqrt(one["m"] / one["k"])
        self.assertAlmostEqual(tyglab.stability(one)["worst_case_limit"], limit, delta=1e-3 * limit)
        self.assertEqual(tyglab.stability(one.but(integrator="implicit_euler"))["every_shape_limit"], np.inf)
        self.assertEqual(tyglab.stability(one.but(dt=1.1 * limit))["zone"], "unstable")
        cloth = tyglab.Simulation(tyglab.Preset(rows=6, columns=6))
        self.assertEqual(cloth.dt_crit, tyglab.stability(cloth.preset)["worst_case_limit"])
        self.assertGreaterEqual(cloth.dt_crit_now, cloth.dt_crit * 0.999)

    def test_errors_are_measured_and_settings_found(self):
        small = tyglab.Preset(rows=6, columns=6)
        found = tyglab.error_study(small, seconds=0.2)
        self.assertGreater(found["error"], 0)
        half = tyglab.error_study(small.but(dt=0.0005), seconds=0.2)
        self.assertLess(half["error"], found["error"])
        points = tyglab.work_precision(small, ["verlet", "rk4"], seconds=0.1)
        self.assertEqual({p["integrator"] for p in points}, {"verlet", "rk4"})
        best = tyglab.find_settings(small, error=1e-4, seconds=0.2)
        self.assertEqual(best, sorted(best, key=lambda p: p["cost"]))
        self.assertLessEqual(tyglab.error_study(best[0]["preset"], seconds=0.2)["error"], 1e-4)
        with self.assertRaises(tyglab.ToleranceError) as caught:
            tyglab.find_settings(small, error=1e-15, seconds=0.2)
        self.assertTrue(caught.exception.tightest is None or caught.exception.tightest > 1e-15)
        with self.assertRaises(tyglab.PresetError):
            tyglab.work_precision(small, ["verlot"])


class Stubs(unittest.TestCase):
    """tyglab.pyi names what the module has, and nothing else."""

    def setUp(self):
        self.tree = ast.parse((ROOT / "app" / "python" / "tyglab.pyi").read_text())

    @staticmethod
    def names(body):
        for node in body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                yield node.name, node
            elif isinstance(node, ast.AnnAssign):
                yield node.target.id, node

    def test_names(self):
        stubs = dict(self.names(self.tree.body))
        public = {name for name in vars(tyglab) if not name.startswith("_")}
        self.assertEqual(set(stubs) - {"ErrorPoint", "__version__"}, public)
        for name, node in stubs.items():
            if isinstance(node, ast.ClassDef) and not issubclass(getattr(tyglab, name, Exception), Exception):
                own = {n for n in vars(getattr(tyglab, name)) if not n.startswith("_")}
                self.assertEqual({n for n, _ in self.names(node.body) if not n.startswith("_")}, own, name)

    def test_everything_says_what_it_is(self):
        for name, thing in vars(tyglab).items():
            if callable(thing):
                self.assertTrue(inspect.getdoc(thing), name)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--tyglab", required=True)
    options, rest = parser.parse_known_args()
    PROGRAM = options.tyglab
    unittest.main(argv=[sys.argv[0], *rest])
