"""Real mouse, keyboard, clipboard and dropped files, from the X server through GLFW to the cloth and its pixels."""

import json
import os

from cases import case, check, main
from sandbox import LEFT, MIDDLE, RIGHT, centre, k_s
from xclient import XClient


def corner(report):
    """The sampled particle in the last row and column, which hangs free."""
    return report["particles"][-1]


def box_around(at, size):
    return at[0] - size / 2, at[1] - size / 2, size, size


def pause(sandbox):
    sandbox.key("space")
    return sandbox.wait(lambda r: r["paused"], "the pause")


@case
def mouse(stage):
    """the right button grabs, and pixels follow; the left one cuts, the middle one orbits, the wheel zooms"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.6, "the cloth to swing")
    pause(sandbox)
    sandbox.rest()
    before = stage.keep("before", still=True)
    x, y = corner(sandbox.report())["at"]
    sandbox.move(x, y)
    sandbox.press(RIGHT)
    to = x + 60, y - 80
    sandbox.move(x + 20, y - 20)
    sandbox.move(*to)
    sandbox.wait(lambda r: r["held"] is not None, "the particle to be held")
    sandbox.key("space")
    sandbox.wait(lambda r: r["held"] and max(abs(a - b) for a, b in zip(r["held"]["at"], to)) < 3,
                 "it to come to the pointer")
    pause(sandbox)
    place = box_around((x, y), 60)
    grabbed = stage.keep("grabbed", still=True)
    check(grabbed.crop(place).differs_from(before.crop(place), 16) > 0.2, "its pixels have gone with it")
    sandbox.release(RIGHT)
    sandbox.wait(lambda r: r["held"] is None and r["torn_springs"] == 0, "it to be let go")
    report = sandbox.later()
    a, b = report["particles"][12]["at"], report["particles"][14]["at"]
    sandbox.drag([a, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), b], LEFT)
    sandbox.wait(lambda r: r["torn_springs"] > 5, "the cut")
    sandbox.rest()
    cut = stage.keep("cut", still=True)
    yaw = sandbox.report()["camera"]["yaw"]
    sandbox.drag([a, (a[0] + 60, a[1] + 10), (a[0] + 150, a[1] + 20)], MIDDLE)
    report = sandbox.wait(lambda r: abs(r["camera"]["yaw"] - yaw) > 0.1, "the camera to turn")
    distance = report["camera"]["distance"]
    sandbox.acted("the wheel", "click", 4)
    sandbox.wait(lambda r: r["camera"]["distance"] < distance, "the camera to come nearer")
    sandbox.rest()
    turned, viewport = stage.keep("turned", still=True), report["viewport"]
    check(turned.crop(viewport).differs_from(cut.crop(viewport), 16) > 0.01, "the picture turns with the camera")


@case
def keys(stage):
    """keys reach the cloth and text fields; a key held down repeats; F11 fills the screen and goes back"""
    sandbox = stage.start("hanging")
    steps = pause(sandbox)["steps"]
    sandbox.acted("the arrow key", "keydown", "Right")
    sandbox.wait(lambda r: r["steps"] >= steps + 4, "the key that is held down to go on stepping")
    sandbox.xdotool("keyup", "Right")
    report = sandbox.later(6)
    check(sandbox.later(6)["steps"] == report["steps"], "it stops with the key")
    sandbox.key("4")
    sandbox.wait(lambda r: r["view"] == 4, "the view")
    check(k_s(sandbox.type_value("k_s", "7.5e1")) == 75, "the value that was typed")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: k_s(r) == 50, "Ctrl+Z to take it back")
    sandbox.key("F11")
    sandbox.wait(lambda r: r["window"] == [stage.screen.width, stage.screen.height], "the window to fill the screen")
    sandbox.key("F11")
    sandbox.wait(lambda r: r["window"] == [1280, 720], "it to be as before")


@case
def one_frame(stage):
    """clicks, drags and words that are over before a frame is count as they would have slowly"""
    sandbox = stage.start("hanging")
    pause(sandbox)
    sandbox.click_control("top.engine")
    x, y = map(round, centre(sandbox.control("menu.cpu_double")))
    sandbox.in_one_frame("mousemove", x, y, "click", 1, "mousemove", x - 300, y + 200)
    sandbox.wait(lambda r: r["preset"]["solver"]["precision"] == "double", "double to be chosen")
    x, y, width, height = map(round, sandbox.control("constants.k_s.slider"))
    a, b, middle = x + width * 3 // 10, x + width * 9 // 10, y + height // 2
    sandbox.in_one_frame("mousemove", a, middle, "mousedown", 1, "mousemove", b, middle, "mouseup", 1)
    report = sandbox.wait(lambda r: k_s(r) > 75, "k_s to follow")
    sandbox.move(5, 400)
    check(k_s(sandbox.later(4)) == k_s(report), "the slider has let go")
    sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"], "a text field")
    sandbox.in_one_frame("key", "--delay", "0", "ctrl+a", "7", "8", "BackSpace", "3", "Return")
    sandbox.wait(lambda r: not r["typing"] and k_s(r) == 73, "73 to be taken")


@case
def clipboard(stage):
    """what is copied in one window is pasted in another program's"""
    first = stage.start("hanging")
    first.type_value("k_s", "77")
    first.double_click(*centre(first.control("constants.k_s.value")), LEFT, lambda r: r["typing"], "a text field")
    first.key("ctrl+a")
    first.key("ctrl+c")
    first.later(3)
    second = stage.start("hanging")
    second.double_click(*centre(second.control("constants.k_s.value")), LEFT, lambda r: r["typing"], "a text field")
    second.key("ctrl+a")
    second.key("ctrl+v")
    second.later(3)
    second.key("Return")
    second.wait(lambda r: not r["typing"] and k_s(r) == 77, "what was copied to be taken")


@case
def dropped(stage):
    """a preset dropped on the window opens"""
    sandbox = stage.start("hanging")
    file = os.path.join(sandbox.own.name, "dropped.json")
    with open(file, "w") as out:
        json.dump({"tyglab_preset": 1, "name": "Dropped", "forces": {"k_s": 66}}, out)
    client = XClient(stage.screen.display)
    client.drop(sandbox.window, file, 640, 360)
    report = sandbox.wait(lambda r: r["label"] == "dropped", "the preset that was dropped")
    client.close()
    check(k_s(report) == 66 and report["file"] == file, "it is the file's")


if __name__ == "__main__":
    main()
