"""The mouse on the cloth: grabbed, cut, picked, pinned; bodies dragged; the camera turned."""

from cases import case, check, main
from sandbox import LEFT, MIDDLE, RIGHT, centre, particle


def apart(a, b):
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]))


def corner(report):
    """The lower right corner's particle, and its row and column."""
    last = report["particles"][-1]
    return last["i"], last["j"]


def middle(report):
    inner = report["particles"][12]
    return inner["i"], inner["j"]


@case
def grab(stage):
    """a particle grabbed with the right button follows the pointer, and is let go with it"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.5, "the cloth to fall a little")
    sandbox.key("space")
    report = sandbox.wait(lambda r: r["paused"], "the pause")
    report = sandbox.later()
    i, j = corner(report)
    x, y = particle(report, i, j)["at"]
    sandbox.move(x, y)
    sandbox.press(RIGHT)
    sandbox.move(x + 12, y - 8)
    report = sandbox.wait(lambda r: r["held"] is not None, "the particle to be held")
    check((report["held"]["i"], report["held"]["j"]) == (i, j), "it is the one under the pointer")
    sandbox.key("space")
    for dx, dy in ((60, -60), (-40, -120), (-80, -30)):
        sandbox.move(x + dx, y + dy)
        target = [x + dx, y + dy]
        report = sandbox.wait(lambda r: r["held"] and apart(r["held"]["at"], target) < 3,
                              f"the particle to come to the pointer at {target}")
        check(apart(particle(report, i, j)["at"], target) < 3, "the report's particle is where the held one is")
    stage.keep("held")
    check(report["torn_springs"] == 0, "a grab tears nothing")
    sandbox.release(RIGHT)
    report = sandbox.wait(lambda r: r["held"] is None, "the particle to be let go")
    there = particle(report, i, j)["x"]
    sandbox.wait(lambda r: r["t"] > report["t"] + 0.3 and particle(r, i, j)["x"] != there, "it to move on by itself")


@case
def release_force(stage):
    """the hand lets go by itself when its force exceeds F_release"""
    sandbox = stage.start("hanging", "--set", "F_release=5")
    report = sandbox.wait(lambda r: r["t"] > 0.5, "the cloth to fall a little")
    i, j = middle(report)
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    x, y = particle(sandbox.later(), i, j)["at"]
    sandbox.move(x, y)
    sandbox.press(RIGHT)
    sandbox.move(x + 10, y)
    begun = sandbox.wait(lambda r: r["held"] is not None, "the particle to be held")["t"]
    sandbox.key("space")
    report = sandbox.wait(lambda r: r["t"] > begun + 0.2, "the cloth to move")
    check(report["held"] is not None, "a hand that rests feels less than F_release and holds on")
    sandbox.move(x + 150, y + 150)
    sandbox.wait(lambda r: r["held"] is None, "the hand to let go")
    sandbox.wait(lambda r: any("F_release" in m for m in r["messages"]), "it to be said")
    sandbox.release(RIGHT)


@case
def cut(stage):
    """a cut with the left button removes springs, while the cloth moves and while it is paused"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.5, "the cloth to fall a little")
    report = sandbox.report()
    check(report["torn_springs"] == 0, "nothing is torn before")
    a, b = particle(report, *middle(report))["at"], report["particles"][14]["at"]
    sandbox.drag([a, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], b])
    running = sandbox.wait(lambda r: r["torn_springs"] > 10, "the cut to remove springs")
    check(running["tool"] == "none", "the cut is over")
    stage.keep("cut")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    before = sandbox.later()
    a, b = before["particles"][5]["at"], before["particles"][6]["at"]
    sandbox.drag([a, b])
    after = sandbox.wait(lambda r: r["torn_springs"] > before["torn_springs"] + 3, "a cut while paused")
    check(after["steps"] == before["steps"], "a cut makes no step")
    stage.keep("cut-paused")
    sandbox.key("BackSpace")
    sandbox.wait(lambda r: r["torn_springs"] == 0 and r["steps"] == 0, "the restart to mend the cloth")


@case
def buttons(stage):
    """a press on a button over the cloth is the button's: nothing is cut"""
    sandbox = stage.start("hanging")
    sandbox.click_control("viewport.views.2")
    report = sandbox.wait(lambda r: r["view"] == 2, "the button to change the view")
    check(sandbox.later()["torn_springs"] == report["torn_springs"] == 0, "the press cut the cloth")


@case
def pick_and_pin(stage):
    """a right click picks a particle, a right double-click pins it and another frees it"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    report = sandbox.later()
    pins, corner_site = report["pinned"], list(corner(report))
    check(report["picked"] != corner_site, "another particle is picked at the start")
    at = particle(report, *corner_site)["at"]
    sandbox.click(*at, RIGHT)
    sandbox.wait(lambda r: r["picked"] == corner_site, "the click to pick the corner")
    stage.keep("picked")
    sandbox.later(4)
    for count, what in ((pins + 1, "pin"), (pins, "free")):
        sandbox.double_click(*at, RIGHT, lambda r: r["pinned"] == count, f"{what} the corner")
        report = sandbox.later(4)
        check(report["pinned"] == count and report["held"] is None, f"the double click did more than to {what} it")
    check(report["steps"] == sandbox.report()["steps"] and report["torn_springs"] == 0, "the mouse did nothing else")


def sphere_at_start(stage):
    """The scene `sphere`, paused at its start, where no cloth lies before the ball; and its report."""
    sandbox = stage.start("sphere")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.key("BackSpace")
    sandbox.wait(lambda r: r["steps"] == 0, "the restart")
    return sandbox, sandbox.later()


@case
def body(stage):
    """a left press on a body drags the body and never cuts"""
    sandbox, report = sphere_at_start(stage)
    x, y = report["bodies"][0]["at"]
    before = report["bodies"][0]["c"]
    sandbox.move(x, y)
    sandbox.press(LEFT)
    check(sandbox.report()["tool"] == "body", "the press took the body, not " + sandbox.report()["tool"])
    sandbox.move(x + 40, y + 5)
    sandbox.move(x + 90, y + 10)
    report = sandbox.wait(lambda r: apart(r["bodies"][0]["at"], [x + 90, y + 10]) < 3, "the body to follow the pointer")
    check(report["bodies"][0]["c"] != before, "its centre changed")
    stage.keep("dragged")
    sandbox.key("space")
    sandbox.wait(lambda r: r["t"] > 0.2, "the cloth to fall on it")
    sandbox.move(x - 60, y - 40)
    sandbox.release(LEFT)
    report = sandbox.later()
    check(report["torn_springs"] == 0, "dragging the body cut the cloth")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: max(abs(a - b) for a, b in zip(r["bodies"][0]["c"], before)) < 1e-12,
                 "one undo to put the body back")


@case
def release_place(stage):
    """a body stays where the button was released, however far the pointer goes in the same frame"""
    sandbox, report = sphere_at_start(stage)
    x, y = report["bodies"][0]["at"]
    sandbox.move(x, y)
    sandbox.press(LEFT)
    sandbox.move(x + 30, y)
    sandbox.acted("the release", "mouseup", LEFT, "mousemove", round(x + 30), round(y - 200))
    report = sandbox.later()
    check(apart(report["bodies"][0]["at"], [x + 30, y]) < 3, f"the body is at {report['bodies'][0]['at']}, not at {[x + 30, y]}")


@case
def camera(stage):
    """the middle button orbits, with Shift it pans, the wheel zooms, F frames; the cloth stays as it is"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    start = sandbox.later()
    x, y = centre(start["viewport"])

    def corners(report):
        return [report["particles"][k]["at"] for k in (0, 4, 20, 24)]

    def width(report):
        return max(p[0] for p in corners(report)) - min(p[0] for p in corners(report))

    sandbox.drag([(x, y), (x + 100, y + 10), (x + 300, y + 20)], MIDDLE)
    turned = sandbox.wait(lambda r: width(r) < 0.7 * width(start), "the cloth to be seen from the side")
    stage.keep("orbited")
    sandbox.acted("Shift going down", "keydown", "shift")
    sandbox.drag([(x, y), (x + 50, y + 20), (x + 100, y + 40)], MIDDLE)
    sandbox.xdotool("keyup", "shift")
    sandbox.wait(lambda r: all(b[0] > a[0] + 40 for a, b in zip(corners(turned), corners(r))), "Shift to pan")
    sandbox.key("f")
    sandbox.wait(lambda r: apart(corners(r)[0], corners(start)[0]) < 40, "F to frame the cloth")
    before = width(sandbox.later())
    for _ in range(3):
        sandbox.xdotool("click", 4)
    sandbox.wait(lambda r: width(r) > 1.2 * before, "the wheel to come nearer")
    report = sandbox.later()
    check((report["steps"], report["torn_springs"], report["held"]) == (start["steps"], 0, None), "only the camera moved")
    check([p["x"] for p in report["particles"]] == [p["x"] for p in start["particles"]], "the cloth stayed as it was")


if __name__ == "__main__":
    main()
