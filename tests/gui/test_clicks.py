"""Clicks and drags that are over before a frame is."""

import os
import signal

from cases import case, check, main
from sandbox import centre


def solver(report):
    return report["preset"]["solver"]


def in_one_frame(sandbox, *arguments):
    """Mouse events that all come while the program draws one frame: it is stopped while they are sent."""
    before = sandbox.report()["events"]
    os.kill(sandbox.process.pid, signal.SIGSTOP)
    sandbox.xdotool(*arguments)
    os.kill(sandbox.process.pid, signal.SIGCONT)
    sandbox.wait(lambda r: r["events"] > before, "the events to arrive")


@case
def quick_click(stage):
    """a click chooses what it met, though press, release and the way on come within one frame"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.click_control("top.engine")
    x, y = map(round, centre(sandbox.control("menu.cpu_double")))
    sandbox.later(3)
    in_one_frame(sandbox, "mousemove", x, y, "click", 1, "mousemove", x - 300, y + 200)
    sandbox.wait(lambda r: solver(r)["precision"] == "double", "double to be chosen")
    sandbox.later(3)
    # The same from the closed menu on: it opens, and the next click chooses.
    top = tuple(map(round, centre(sandbox.control("top.engine"))))
    in_one_frame(sandbox, "mousemove", *top, "click", 1, "mousemove", x - 300, y + 200)
    x, y = map(round, centre(sandbox.control("menu.cpu_float")))
    in_one_frame(sandbox, "mousemove", x, y, "click", 1, "mousemove", 5, 400)
    sandbox.wait(lambda r: solver(r)["precision"] == "float", "float to be chosen")
    # Three clicks within a frame are three.
    play = tuple(map(round, centre(sandbox.control("top.play"))))
    step = tuple(map(round, centre(sandbox.control("top.step"))))
    steps = sandbox.report()["steps"]
    in_one_frame(sandbox, "mousemove", *step, "click", 1, "click", 1, "click", 1, "mousemove", *play)
    report = sandbox.wait(lambda r: r["steps"] >= steps + 3, "three clicks to make three steps")
    check(sandbox.later(4)["steps"] == steps + 3, "three clicks make three steps")
    check(report["paused"], "the pointer has passed over Run alone")


@case
def slow_frames(stage):
    """a click without a pause before the way on counts while a large cloth makes frames long"""
    sandbox = stage.start("hanging", "--set", "rows=385", "--set", "columns=385", "--set", "L=0.003")
    sandbox.click_control("top.engine")
    x, y = map(round, centre(sandbox.control("menu.cpu_double")))
    sandbox.xdotool("mousemove", x, y, "click", 1, "mousemove", x - 300, y + 200)
    sandbox.wait(lambda r: solver(r)["precision"] == "double", "double to be chosen")


@case
def drag(stage):
    """a whole drag within one frame turns a slider to where it ends"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    x, y, width, height = sandbox.control("constants.k_s.slider")
    before = sandbox.report()["preset"]["forces"]["k_s"]
    at = round(x + width * 0.3), round(y + height / 2)
    in_one_frame(sandbox, "mousemove", *at, "mousedown", 1, "mousemove", round(x + width * 0.9), at[1], "mouseup", 1)
    sandbox.wait(lambda r: r["preset"]["forces"]["k_s"] > 1.5 * before, "k_s to follow")
    value = sandbox.later(4)["preset"]["forces"]["k_s"]
    sandbox.move(5, 400)
    check(sandbox.later(4)["preset"]["forces"]["k_s"] == value, "the slider has let go")


if __name__ == "__main__":
    main()
