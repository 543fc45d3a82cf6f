"""The window itself: opened, resized, scaled, closed."""

import json
import os
import shutil
import subprocess
import tempfile

from cases import case, check, main, skip
from sandbox import Sandbox
from screen import Screen
from xclient import XClient

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


def check_options(sandbox):
    """--size is the window's, --threads reaches the engine, and a cloth finer than the window is drawn."""
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
def resizing(stage):
    """the size asked for is given; resizing redraws the whole window at every size, and its controls stay within it"""
    sandbox = stage.start("hanging")
    check_options(sandbox)
    for width, height in ((900, 600), (1560, 960), (640, 400), (480, 320), (1280, 720)):
        resize(sandbox, width, height)
        report = sandbox.later(4)
        check(min(report["viewport"][2:]) >= 200, f"the cloth keeps room: {report['viewport']}")
        check_controls(report)
        check_apart(report, "top")
        check("top.play" in report["controls"], "the transport is there at any size")
        check_filled(stage.keep(f"{width}x{height}"), f"a part of the window is black at {width} x {height}")
    steps = sandbox.report()["steps"]
    sandbox.wait(lambda r: r["steps"] > steps and r["divergence"] is None, "the cloth to move on")


@case
def text_scale(stage):
    """text is as large as the monitor's settings and Ctrl with + and - make it, and is drawn in that size"""
    def row_height(sandbox):
        return sandbox.control("constants.k_s.slider")[3]

    def row_in(report):
        return report["controls"].get("constants.k_s.slider", [0] * 4)[3]

    plain = stage.start("hanging")
    height = row_height(plain)
    plain.key("ctrl+q")
    plain.ended()
    client = XClient(stage.screen.display)
    client.set_dpi(144)
    sandbox = stage.start("hanging")
    client.set_dpi(96)
    client.close()
    sandbox.key("space")
    scaled = row_height(sandbox)
    check(abs(scaled - 1.5 * height) <= 1, f"at 144 dpi a row is {scaled} high, at 96 {height}")
    for _ in range(4):
        sandbox.key("ctrl+plus")
    larger = sandbox.wait(lambda r: row_in(r) > 1.9 * height, "the rows to grow")
    check_controls(larger)
    large = stage.keep("larger", still=True).crop(larger["controls"]["top.play"])
    sandbox.key("ctrl+0")
    sandbox.wait(lambda r: row_in(r) == scaled, "Ctrl+0 to end it")
    sandbox.rest()
    again = stage.keep("as-before", still=True).crop(larger["controls"]["top.play"])
    check(again != large, "it is drawn smaller again")


@case
def start_and_end(stage):
    """the first start shows the start page once, and the tour from there; closing is clean: exit code 0, nothing on stderr, all of it remembered"""
    first = stage.start(with_settings=False)
    first.wait(lambda r: r["dialog"] == "start", "the start page")
    check_filled(stage.keep("first"), "a part of the first window is black")
    first.click_control("dialog.Take_the_tour")
    first.wait(lambda r: r["tour"] == 0, "the tour")
    first.click_control("tour.Next")
    first.wait(lambda r: r["tour"] == 1, "its second card")
    first.click_control("tour.Skip_the_tour")
    first.wait(lambda r: r["tour"] == -1, "it to be skipped")
    first.press_close_button()
    check(first.ended() == 0, f"the exit code is {first.process.returncode}")
    check(first.stderr() == "", "it says nothing on stderr: " + first.stderr())
    check(first.report()["ended"], "the last report says that it ended")
    with open(first.settings_file) as file:
        settings = json.load(file)
    check(settings["tour_seen"], "that it was seen is remembered")
    check(settings["session"]["label"] == first.report()["label"], "so is the preset")
    again = stage.start(config=first.config)
    check(again.later(6)["dialog"] == "none", "it was seen before")
    again.key("ctrl+q")
    check(again.ended() == 0, "Ctrl+Q ends it too")
    named = stage.start("one_weight", tour_seen=False)
    report = named.wait(lambda r: r["steps"] > 20, "the motion")
    check(report["dialog"] == "none", "who names a preset gets no start page")
    named.press_close_button()
    check(named.ended() == 0 and named.stderr() == "", f"it ends well: {named.process.returncode}, {named.stderr()}")


@case
def first_size(stage):
    """the first window is larger on a display that magnifies"""
    client = XClient(stage.screen.display)
    client.set_dpi(105.6)
    sandbox = stage.start("hanging", with_settings=False)
    client.set_dpi(96)
    client.close()
    width, height = sandbox.report()["window"]
    check(abs(width - 1.1 * 1440) <= 1 and abs(height - 1.1 * 860) <= 1, f"at scale 1.1 it is {width} x {height}")


@case
def without_glx(stage):
    """where the X server has no GLX, the window opens through EGL"""
    screen = Screen(options=("-extension", "GLX"))
    try:
        sandbox = Sandbox(stage.tyglab, screen, ["hanging"])
        sandbox.wait(lambda r: r["t"] > 0, "the cloth to move")
        picture = screen.picture()
        check(len({picture.pixel(x, 400) for x in range(0, 1280, 8)}) > 5, "the window is drawn")
        sandbox.close()
    finally:
        screen.close()


@case
def dying_driver(stage):
    """where the OpenCL driver dies late, here for want of a linker, the CPU engine goes on with a sentence"""
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(shutil.which("xdotool"), os.path.join(folder, "xdotool"))
        own = {"PATH": folder, "HOME": folder, "XDG_CACHE_HOME": folder, "POCL_CACHE_DIR": os.path.join(folder, "pocl")}
        sandbox = stage.start("hanging", "--engine", "opencl", environment=own)
        report = sandbox.wait(lambda r: r["t"] > 0.1 and r["building"] is None, "it to move, on what can run it")
        if report["preset"]["solver"]["engine"] == "opencl":
            skip("this OpenCL driver needs no linker")
        said = sandbox.stderr().splitlines()
        if said and "No OpenCL device was found" in said[0]:
            skip("there is no OpenCL device")
        check(len(said) == 1 and said[0].startswith("tyglab: The OpenCL driver ")
              and said[0].endswith("The CPU engine continues."), str(said))
        stage.keep("took_over")


if __name__ == "__main__":
    main()
