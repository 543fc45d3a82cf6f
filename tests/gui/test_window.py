"""The window: resized, closed, scaled; its borders dragged."""

import json
import os
import shutil
import signal
import subprocess
import tempfile

from cases import case, check, main

BLACK = (0, 0, 0)


def resize(sandbox, width, height):
    sandbox.xdotool("windowsize", sandbox.window, width, height)
    return sandbox.wait(lambda r: r["window"] == [width, height], f"the window to be {width} x {height}")


def check_controls(report):
    width, height = report["window"]
    for name, (x, y, w, h) in report["controls"].items():
        check(x >= -1 and y >= -1 and x + w <= width + 1 and y + h <= height + 1,
              f"{name} at {x}, {y} ({w} x {h}) is not within {width} x {height}")


def check_apart(report, region):
    """No two controls of a region overlap."""
    boxes = [(name, box) for name, box in report["controls"].items() if name.startswith(region + ".")]
    for k, (name, (x, y, w, h)) in enumerate(boxes):
        for other, (x2, y2, w2, h2) in boxes[:k]:
            check(x + w <= x2 + 1 or x2 + w2 <= x + 1 or y + h <= y2 + 1 or y2 + h2 <= y + 1,
                  f"{name} and {other} overlap at {report['window']}")


def check_filled(picture, text):
    """No edge of the window is left black: all of it was drawn."""
    edges = picture.row(2) + picture.row(picture.height - 3)
    edges += [picture.pixel(x, y) for x in (2, picture.width - 3) for y in range(picture.height)]
    check(sum(pixel == BLACK for pixel in edges) < 0.02 * len(edges), text)


@case
def resizing(stage):
    """resizing redraws the whole window at every size, and its controls stay within it"""
    sandbox = stage.start("hanging")
    for width, height in ((900, 600), (1560, 960), (640, 400), (480, 320), (1280, 720)):
        resize(sandbox, width, height)
        report = sandbox.later(4)
        check(report["viewport"][2] >= 200 and report["viewport"][3] >= 200, f"the cloth keeps room: {report['viewport']}")
        check_controls(report)
        check_apart(report, "top")
        check("top.play" in report["controls"], "the transport is there at any size")
        check_filled(stage.keep(f"{width}x{height}"), f"a part of the window is black at {width} x {height}")
    steps = sandbox.report()["steps"]
    sandbox.wait(lambda r: r["steps"] > steps and r["divergence"] is None, "the cloth to move on")


@case
def narrow(stage):
    """where both columns have no room, tabs choose one; what asks for a card, or for a constant, brings it"""
    sandbox = stage.start("hanging", size=(700, 600))
    report = sandbox.later(4)
    check("side.columns.2" in report["controls"] and "constants.k_s.slider" in report["controls"], "constants at first")
    sandbox.click_control("side.columns.2")
    report = sandbox.wait(lambda r: "plots.Stability" in r["controls"], "the plots in their place")
    check("constants.k_s.slider" not in report["controls"], "one column at a time")
    check_controls(report)
    stage.keep("plots")
    sandbox.click_control("side.columns.1")
    sandbox.wait(lambda r: "constants.k_s.slider" in r["controls"], "the constants again")
    sandbox.key("m")
    sandbox.wait(lambda r: "plots.map" in r["controls"], "the map to be shown, though the constants stood there")
    stage.keep("map")
    sandbox.key("m")
    resize(sandbox, 1280, 720)
    report = sandbox.later(4)
    check("side.columns.1" not in report["controls"], "no tabs where both have room")
    check("constants.k_s.slider" in report["controls"] and "plots.Stability" in report["controls"], "both columns")


@case
def borders(stage):
    """the borders between the regions drag, and the cloth gets what is left"""
    sandbox = stage.start("hanging")
    x, y, width, height = sandbox.report()["viewport"]
    sandbox.drag([(x, y + 300), (x - 20, y + 300), (x - 60, y + 310)])
    report = sandbox.wait(lambda r: abs(r["viewport"][0] - (x - 60)) <= 2, "the left border to follow")
    check(report["viewport"][2] > width + 50, "the viewport grew")
    right = x + width
    sandbox.drag([(right, y + 300), (right - 30, y + 300), (right - 80, y + 290)])
    report = sandbox.wait(lambda r: abs(sum(r["viewport"][0:3:2]) - (right - 80)) <= 2, "the right border to follow")
    check(report["torn_springs"] == 0, "dragging a border cut the cloth")
    stage.keep("dragged")


@case
def text_size(stage):
    """Ctrl and + or - change the size of text; Ctrl+0 brings it back"""
    sandbox = stage.start("hanging")
    height = sandbox.control("constants.k_s.slider")[3]
    for _ in range(4):
        sandbox.key("ctrl+plus")
    sandbox.wait(lambda r: r["controls"].get("constants.k_s.slider", [0] * 4)[3] > 1.3 * height, "the rows to grow")
    report = sandbox.later(4)
    check_controls(report)
    stage.keep("larger")
    for _ in range(5):
        sandbox.key("ctrl+plus")
    resize(sandbox, 640, 400)
    report = sandbox.later(4)
    check_apart(report, "top")
    check("top.play" in report["controls"], "the transport is there with the largest text in a small window")
    stage.keep("largest-in-a-small-window")
    resize(sandbox, 1280, 720)
    sandbox.key("ctrl+0")
    sandbox.wait(lambda r: r["controls"].get("constants.k_s.slider", [0] * 4)[3] == height, "Ctrl+0 to bring it back")


@case
def closing(stage):
    """closing is clean: exit code 0, nothing on stderr, settings and the last report written"""
    for name in ("hanging", "one_weight"):
        sandbox = stage.start(name)
        sandbox.wait(lambda r: r["steps"] > 20, "the motion")
        stage.keep(name)
        sandbox.press_close_button()
        check(sandbox.ended() == 0, f"the exit code is {sandbox.process.returncode}")
        check(sandbox.stderr() == "", "it says nothing on stderr: " + sandbox.stderr())
        with open(sandbox.settings_file) as file:
            settings = json.load(file)
        check(settings["session"]["label"] == name, "the session is remembered")
        check(sandbox.report()["ended"], "the last report says that it ended")
    sandbox = stage.start("flag")
    sandbox.key("ctrl+q")
    check(sandbox.ended() == 0, "Ctrl+Q ends it too")


@case
def threads(stage):
    """--threads reaches the engine, and a cloth finer than the window is drawn from a part of it"""
    sandbox = stage.start("hanging")
    out = os.path.join(sandbox.own.name, "costs.json")
    done = subprocess.run([sandbox.tyglab, "hanging", "--set", "rows=1500", "--set", "columns=1500", "--set", "L=6e-4",
                           "--dt", "1e-6", "--threads", "2", "--size", "800x500", "--frames", "2", "--time-report",
                           out], env=sandbox.environment, capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    with open(out) as file:
        report = json.load(file)
    check("2 threads" in report["engine"], "the engine has two threads")
    check((report["width"], report["height"]) == (800, 500), "--size is the window's")


@case
def interrupted(stage):
    """Ctrl-C in the terminal ends it cleanly with exit code 130"""
    sandbox = stage.start("hanging")
    sandbox.process.send_signal(signal.SIGINT)
    check(sandbox.ended() == 130, f"the exit code is {sandbox.process.returncode}")
    check(sandbox.report()["ended"], "the last report says that it ended")


@case
def dying_driver(stage):
    """where the OpenCL driver dies late, here for want of a linker, the CPU engine goes on with a sentence"""
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(shutil.which("xdotool"), os.path.join(folder, "xdotool"))
        own = {"PATH": folder, "HOME": folder, "XDG_CACHE_HOME": folder, "POCL_CACHE_DIR": os.path.join(folder, "pocl")}
        sandbox = stage.start("hanging", "--engine", "opencl", environment=own)
        report = sandbox.wait(lambda r: r["t"] > 0.1, "it to move")
        if report["preset"]["solver"]["engine"] == "opencl":
            print("        this OpenCL driver needs no linker: nothing more is tried")
            return
        said = sandbox.stderr().splitlines()
        check(len(said) == 1 and said[0].startswith("tyglab: The OpenCL driver ")
              and said[0].endswith("The CPU engine runs it instead."), str(said))
        stage.keep("took_over")


if __name__ == "__main__":
    main()
