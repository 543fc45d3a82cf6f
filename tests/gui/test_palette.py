"""Ctrl+P, the tour, and the help that leads to both."""

import json

from cases import case, check, main
from sandbox import centre, k_s


def find(sandbox, text):
    sandbox.wait(lambda r: not r["palette"] and not r["typing"], "the last one to be closed")
    sandbox.later(3)
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette to take keys")
    sandbox.later(3)
    sandbox.type(text)
    return sandbox.later(4)


@case
def commands(stage):
    """Ctrl+P finds commands, methods, constants and presets by what is typed, with mouse and keyboard"""
    sandbox = stage.start("hanging")
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"], "the palette")
    sandbox.later(4)
    stage.keep("all")
    sandbox.key("Escape")
    sandbox.wait(lambda r: not r["palette"], "Escape to close it")
    find(sandbox, "rk4")
    stage.keep("rk4")
    sandbox.key("Return")
    sandbox.wait(lambda r: r["preset"]["solver"]["integrator"] == "rk4", "the method to be taken")
    find(sandbox, "run or")
    sandbox.key("Return")
    report = sandbox.wait(lambda r: r["paused"], "the motion to pause")
    check(not report["palette"], "it is closed")
    find(sandbox, "dare inte")
    sandbox.key("Return")
    check(sandbox.later(6)["palette"], "nothing is found, so nothing is done")
    sandbox.key("ctrl+a")
    sandbox.type("constant, stretching")
    sandbox.later(4)
    sandbox.key("Down")
    sandbox.key("Up")
    sandbox.key("Return")
    sandbox.wait(lambda r: not r["palette"], "the constant to be found")
    sandbox.later(3)
    sandbox.key("Right")
    sandbox.wait(lambda r: k_s(r) > 50, "its slider to take the arrow")
    sandbox.key("Escape")
    find(sandbox, "outlines")
    sandbox.click_control("palette.View.Outlines")
    sandbox.wait(lambda r: r["view"] == 4, "the view, by a click")
    find(sandbox, "flag in")
    sandbox.key("Return")
    sandbox.wait(lambda r: r["dialog"] == "unsaved", "the question, since constants have changed")


@case
def elsewhere(stage):
    """a click beside the palette closes it and does nothing to the cloth"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    find(sandbox, "zzz")
    stage.keep("nothing")
    x, y, width, height = sandbox.report()["viewport"]
    sandbox.click(x + width / 2, y + height - 60)
    report = sandbox.wait(lambda r: not r["palette"], "it to close")
    check(report["torn_springs"] == 0, "the cloth is whole")


@case
def tour(stage):
    """the first start shows the tour; it can be walked through, skipped and seen again"""
    sandbox = stage.start(tour_seen=False)
    report = sandbox.wait(lambda r: r["tour"] == 0, "the first card")
    for card in range(5):
        sandbox.wait(lambda r: r["tour"] == card, f"card {card + 1}")
        sandbox.later(4)
        stage.keep(f"card-{card + 1}")
        if card < 4:
            sandbox.click_control("tour.Next")
    sandbox.click_control("tour.Back")
    sandbox.wait(lambda r: r["tour"] == 3, "the card before")
    sandbox.key("Return")
    sandbox.key("Return")
    sandbox.wait(lambda r: r["tour"] == -1, "the end of the tour")
    sandbox.key("F1")
    sandbox.click_control("help.Take_the_tour")
    sandbox.wait(lambda r: r["tour"] == 0, "the tour again")
    sandbox.click_control("tour.Skip_the_tour")
    sandbox.wait(lambda r: r["tour"] == -1, "it to be skipped")
    sandbox.key("F1")
    sandbox.later(4)
    stage.keep("help")
    sandbox.key("Escape")
    sandbox.press_close_button()
    check(sandbox.ended() == 0, "it ends")
    with open(sandbox.settings_file) as file:
        check(json.load(file)["tour_seen"], "that it was seen is remembered")


@case
def once(stage):
    """who has seen the tour, or names a preset, does not get it"""
    sandbox = stage.start()
    check(sandbox.later(6)["tour"] == -1, "it was seen before")
    sandbox.key("ctrl+q")
    sandbox.ended()
    sandbox = stage.start("hanging", tour_seen=False)
    check(sandbox.later(6)["tour"] == -1, "a preset was named")


if __name__ == "__main__":
    main()
