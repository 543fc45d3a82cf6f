"""Constants are changed by slider, by typing and by keys, undone and reset; the integrator is switched while running."""

import time

from cases import case, check, main
from sandbox import LEFT, centre, k_s

PRESET_K_S = 50


def along(box, part):
    """A point on a slider, 0 at its left end, 1 at its right."""
    return box[0] + 1 + part * (box[2] - 2), box[1] + box[3] / 2


@case
def slider(stage):
    """dragging the slider of k_s changes k_s, and one undo takes the whole drag back"""
    sandbox = stage.start("hanging", "--dt", "1e-4")
    start = sandbox.report()
    check(k_s(start) == PRESET_K_S and not start["unsaved"], "the preset starts as it is on disk")
    box = sandbox.control("constants.k_s.slider")
    sandbox.move(*along(box, 0.25))
    sandbox.press()
    low = k_s(sandbox.wait(lambda r: k_s(r) < PRESET_K_S, "k_s to follow the press at a quarter of the slider"))
    sandbox.move(*along(box, 0.5))
    sandbox.move(*along(box, 0.75))
    high = k_s(sandbox.wait(lambda r: k_s(r) > PRESET_K_S, "k_s to follow the drag to three quarters"))
    check(10 < high / low < 100, f"half of a slider of three decades is a factor of about 32, not {high / low:g}")
    stage.keep("dragged")
    sandbox.release()
    report = sandbox.wait(lambda r: r["unsaved"], "the change to count as unsaved")
    sandbox.wait(lambda r: r["t"] > report["t"] > start["t"] and r["divergence"] is None, "the cloth to go on moving")
    sandbox.key("ctrl+z")
    report = sandbox.wait(lambda r: k_s(r) == PRESET_K_S, "undo to take the whole drag back")
    check(not report["unsaved"], "nothing is unsaved after the undo")
    sandbox.key("ctrl+shift+z")
    sandbox.wait(lambda r: k_s(r) == high, "redo to bring it again")


@case
def ends(stage):
    """a slider dragged far beyond its ends gives 0 at the left and its largest value at the right"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    box = sandbox.control("constants.k_b.slider")
    sandbox.drag([along(box, 0.5), along(box, 0.1), (3, box[1] + 10)])
    sandbox.wait(lambda r: r["preset"]["forces"]["k_b"] == 0, "k_b to be 0 at the left end")
    sandbox.drag([along(box, 0.01), along(box, 0.9), (1200, box[1] + 10)])
    report = sandbox.wait(lambda r: r["preset"]["forces"]["k_b"] > 100, "k_b to be large at the right end")
    check(report["torn_springs"] == 0, "a drag that left the slider cut the cloth")


@case
def typed(stage):
    """a value typed after Ctrl+click is taken; Escape, nonsense and values out of range leave it as it was"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    report = sandbox.type_value("k_s", "310")
    check(k_s(report) == 310, f"310 was typed, k_s is {k_s(report)}")
    sandbox.wait(lambda r: r["dt_over_limit"] and r["dt_over_limit"] > 1, "the gauge to say that dt is too long for it")
    report = sandbox.type_value("k_s", "7", end="Escape")
    check(k_s(report) == 310, "Escape left the value as it was")
    for text, message in (("abc", "not a number"), ("1e12", "ranges from"), ("-3", "ranges from"), ("nan", "not a number")):
        report = sandbox.type_value("k_s", text)
        check(k_s(report) == 310, f"“{text}” made k_s {k_s(report)}")
        sandbox.wait(lambda r: any(message in m for m in r["messages"]), f"a message about “{text}”")
    stage.keep("messages")
    report = sandbox.type_value("dt", "2e-4")
    check(report["preset"]["solver"]["dt"] == 2e-4, "2e-4 was typed as dt")
    check(report["steps"] == sandbox.later()["steps"], "typing made no step")
    sandbox.key("ctrl+z")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: k_s(r) == PRESET_K_S and r["preset"]["solver"]["dt"] == 0.001, "two undos to take both back")


@case
def double_clicked(stage):
    """a double click on a number lets one type it, also while its slider has the keys; Ctrl+Q quits from there"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.click(*along(sandbox.control("constants.k_s.slider"), 0.5))
    sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"], "a text field")
    sandbox.later(2)
    sandbox.type("310")
    sandbox.later(3)
    sandbox.key("Return")
    report = sandbox.wait(lambda r: k_s(r) == 310, "310 to be taken")
    sandbox.key("ctrl+z")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: not r["unsaved"], "two undos to take both back")
    sandbox.double_click(*centre(sandbox.control("constants.k_b.value")), LEFT, lambda r: r["typing"], "a text field")
    sandbox.xdotool("key", "ctrl+q")
    check(sandbox.ended() == 0, "Ctrl+Q ends it while a number is typed")


@case
def typed_fast(stage):
    """keys that fall into one long frame arrive all and in order: select all, digits, a backspace, Enter"""
    sandbox = stage.start("hanging")
    for keys, value in ((["ctrl+a", "5", "1", "Return"], 51), (["BackSpace", "6", "2", "Return"], 62),
                        (["ctrl+a", "7", "8", "BackSpace", "3", "Return"], 73)):
        sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"],
                             "a text field")
        sandbox.xdotool("key", "--delay", "4", *keys)
        sandbox.wait(lambda r: not r["typing"], "the text field to close")
        check(k_s(sandbox.report()) == value, f"{value} is taken, not {k_s(sandbox.report())}")


@case
def typed_held(stage):
    """a key still down at the end of a long frame acts in its turn, and once"""
    sandbox = stage.start("hanging")
    for value in (51, 62, 73):
        sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"],
                             "a text field")
        first, second = str(value)
        sandbox.xdotool("key", "--delay", "4", "ctrl+a", "8", "keydown", "BackSpace", "sleep", "0.1",
                        "keyup", "BackSpace", "key", "--delay", "4", first, second, "Return")
        sandbox.wait(lambda r: not r["typing"], "the text field to close")
        check(k_s(sandbox.report()) == value, f"{value} is taken, not {k_s(sandbox.report())}")


@case
def dismissed(stage):
    """a click anywhere on a message takes it away"""
    sandbox = stage.start("hanging")
    sandbox.type_value("k_s", "abc")
    sandbox.wait(lambda r: r["messages"], "the message")
    sandbox.click_control("viewport.dismiss")
    report = sandbox.wait(lambda r: not r["messages"], "the message to go")
    check(report["torn_springs"] == 0, "the click did not go through to the cloth")


@case
def reset(stage):
    """a double click on a slider brings the preset's value back, Ctrl+R those of all constants"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.type_value("k_s", "310")
    sandbox.type_value("k_b", "9")
    report = sandbox.double_click(*along(sandbox.control("constants.k_s.slider"), 0.9), LEFT,
                                  lambda r: k_s(r) == PRESET_K_S, "k_s to be reset")
    check(report["preset"]["forces"]["k_b"] == 9, "k_b stayed")
    sandbox.type_value("k_s", "20")
    sandbox.key("ctrl+r")
    sandbox.wait(lambda r: not r["unsaved"], "Ctrl+R to reset all constants")


@case
def rows(stage):
    """rows typed anew (the wheel scrolls to them) build the cloth anew and keep the rest"""
    sandbox = stage.start("hanging", "--set", "k_s=77")
    sandbox.scroll_to("constants.rows.value", over="constants.k_s.value")
    report = sandbox.type_value("rows", "20")
    check(report["preset"]["cloth"]["rows"] == 20 and k_s(report) == 77, "20 rows, and k_s is kept")
    check(max(p["i"] for p in report["particles"]) == 19, "the last row is row 19")
    stage.keep("twenty-rows")
    report = sandbox.type_value("rows", "1")
    check(report["preset"]["cloth"]["rows"] == 20, "one row is too few")
    sandbox.wait(lambda r: r["steps"] > report["steps"], "the cloth to go on moving")


@case
def arrows(stage):
    """a slider in use takes the arrow keys for itself; once left, → steps again"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    before = sandbox.wait(lambda r: r["paused"], "the pause")["steps"]
    box = sandbox.control("constants.k_s.slider")
    sandbox.click(*along(box, 0.5))
    value = k_s(sandbox.later())
    for _ in range(3):
        sandbox.key("Right")
    report = sandbox.wait(lambda r: k_s(r) > 1.05 * value, "three arrow keys to raise k_s by some per cent")
    check(report["steps"] == before, "an arrow key on a slider made a step")
    sandbox.key("Escape")
    sandbox.key("Right")
    sandbox.wait(lambda r: r["steps"] == before + 1, "→ to step once the slider is left")


@case
def integrator(stage):
    """the integrator is switched while the cloth moves, and the motion goes on"""
    sandbox = stage.start("hanging", "--dt", "1e-4")
    for name in ("euler", "improved_euler", "verlet"):
        sandbox.click_control("constants.integrator")
        sandbox.click_control("menu." + name)
        before = sandbox.wait(lambda r: r["preset"]["solver"]["integrator"] == name, f"the integrator to be {name}")
        after = sandbox.wait(lambda r: r["steps"] > before["steps"] + 20, f"the motion to go on with {name}")
        check(after["t"] > before["t"] > 0 and after["divergence"] is None, f"the motion went on with {name}")
    stage.keep("switched")


@case
def tooltips(stage):
    """a tooltip stands beside its row and hides no constant; while the help is open there is none"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.rest()
    before = stage.keep("without", still=True)
    # The pointer's own picture hangs down into the slider below it.
    boxes = [sandbox.control(f"constants.{name}")
             for name in ("dt.slider", "dt.value", "k_b.value", "k_d.slider", "k_d.value", "g.slider", "g.value")]
    x, y = centre(sandbox.control("constants.k_s.slider"))
    sandbox.move(x, y)
    viewport = sandbox.report()["viewport"]
    beside = (viewport[0] + 8, y - 10, 200, 60)
    until(stage, lambda now: now.crop(beside).differs_from(before.crop(beside)) > 0.5, "the tooltip to come")
    now = stage.keep("tooltip", still=True)
    for box in boxes:
        check(now.crop(box) == before.crop(box), f"the tooltip hides a constant at {box}")
    sandbox.rest()
    sandbox.key("F1")
    sandbox.later(4)
    sandbox.move(40, y)
    help_alone = stage.keep("help", still=True)
    sandbox.move(44, y)
    time.sleep(1)
    sandbox.later(2)
    check(stage.keep("help-after-a-second", still=True).crop(viewport) == help_alone.crop(viewport), "no tooltip over the help")


def until(stage, condition, what, seconds=30):
    """Waits for a condition on the screen's pixels."""
    end = time.monotonic() + seconds
    while not condition(stage.screen.picture()):
        check(time.monotonic() < end, f"waited in vain for {what}")
        time.sleep(0.2)


if __name__ == "__main__":
    main()
