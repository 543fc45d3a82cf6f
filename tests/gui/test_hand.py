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
def cut_along(stage):
    """C makes a cut run along the pointer's path: a slanting stroke parts the springs that it crosses, and is seen"""
    sandbox = stage.start("taut_sheet")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.key("c")
    sandbox.wait(lambda r: r["handling"]["cut_along_path"] and any("crosses" in m for m in r["messages"]), "the other way to cut")
    report = sandbox.later()
    corners = [report["particles"][k]["at"] for k in (0, 4, 20, 24)]
    a = [corners[0][0] + 0.2 * (corners[1][0] - corners[0][0]), corners[0][1] + 0.3 * (corners[2][1] - corners[0][1])]
    b = [corners[0][0] + 0.8 * (corners[1][0] - corners[0][0]), corners[0][1] + 0.8 * (corners[2][1] - corners[0][1])]
    sandbox.move((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    sandbox.later()
    stage.keep("nick")
    sandbox.move(*a)
    sandbox.press(LEFT)
    for part in (0.25, 0.5, 0.75, 1):
        sandbox.move(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]))
        stage.keep("stroke")
    sandbox.release(LEFT)
    report = sandbox.later()
    check(20 < report["torn_springs"] < 400, f"{report['torn_springs']} springs are torn")
    check(report["steps"] == sandbox.report()["steps"], "a cut makes no step")
    sandbox.key("space")
    sandbox.wait(lambda r: r["t"] > 0.15, "the cut to open")
    stage.keep("open")
    again = sandbox.report()["torn_springs"]
    sandbox.wait(lambda r: r["t"] > 0.2, "time to pass")
    check(sandbox.report()["torn_springs"] == again, "nothing is cut once the knife is put away")
    sandbox.key("ctrl+q")
    sandbox.click_the_end("dialog.Discard_the_changes") if sandbox.report()["dialog"] == "unsaved" else sandbox.ended()
    other = stage.start("hanging", config=sandbox.config)
    check(other.report()["handling"]["cut_along_path"], "the next session remembers it")


@case
def wind(stage):
    """the wind's arrow is dragged by its tip, and one undo takes it back; W shows and hides it"""
    sandbox = stage.start("flag")
    sandbox.wait(lambda r: r["t"] > 0.5, "the flag to fly")
    report = sandbox.later()
    x, y = report["wind"]["tip"]
    before = report["wind"]["W"]
    stage.keep("arrow")
    sandbox.drag([(x, y), (x + 4, y - 20), (x + 8, y - 60)])
    report = sandbox.wait(lambda r: r["wind"]["W"][1] > 0.001, "the wind to blow upwards")
    check(report["torn_springs"] == 0 and report["tool"] == "none", "the drag cut nothing")
    check(apart(report["wind"]["tip"], [x + 8, y - 60]) < 4, "the tip came to the pointer")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: r["wind"]["W"] == before, "one undo to bring the old wind back")
    sandbox.key("w")
    sandbox.wait(lambda r: r["wind"]["tip"] is None, "W to hide it")
    sandbox.key("w")
    sandbox.wait(lambda r: r["wind"]["tip"] is not None, "W to show it")


@case
def gusts(stage):
    """in gusts the wind that blows is shown beside W, and follows simulated time"""
    sandbox = stage.start("flag", "--set", "gust=0.6", "--set", "gust_period=0.8")
    seen = set()
    for n in range(1, 6):
        report = sandbox.wait(lambda r: r["t"] > 0.15 * n, "the flag to fly")
        check(report["wind"]["W"][0] == 0.004, "W itself stays")
        seen.add(round(report["wind"]["now"][0], 5))
    check(len(seen) >= 3, f"the wind changes: {seen}")
    stage.keep("flag")


@case
def slow_hand(stage):
    """with slow motion in the hand time goes at a quarter while a particle is held, and at its speed afterwards"""
    sandbox = stage.start("hanging")
    sandbox.key("h")
    report = sandbox.wait(lambda r: r["handling"]["slow_hand"], "the setting")
    check(report["aim"] == report["speed"] == 1, "nothing is slow yet")
    x, y = particle(sandbox.later(), *middle(report))["at"]
    sandbox.move(x, y)
    sandbox.press(RIGHT)
    sandbox.move(x + 20, y)
    report = sandbox.wait(lambda r: r["held"] is not None and r["aim"] == 0.25, "slow motion while it is held")
    check(report["speed"] == 1, "the speed that was chosen stays")
    sandbox.later(30)
    stage.keep("held")
    sandbox.release(RIGHT)
    sandbox.wait(lambda r: r["aim"] == 1, "the speed to come back")


@case
def arrows(stage):
    """a tick in the read-out shows a variable's arrow; what is ticked is remembered"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.6, "the cloth to swing")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    check(sandbox.report()["handling"]["arrows"] == ["F_b", "F_d", "F_g", "F_s"], "four are ticked at first")
    for name in ("F", "v", "a"):
        sandbox.click_control("constants." + name)
        sandbox.wait(lambda r: name in r["handling"]["arrows"], f"the arrow of {name}")
    sandbox.click_control("constants.F_s")
    report = sandbox.wait(lambda r: "F_s" not in r["handling"]["arrows"], "F_s to go")
    sandbox.click_control("constants.x")
    check("x" not in sandbox.later()["handling"]["arrows"], "a position is no arrow")
    sandbox.move(*centre(report["viewport"]))
    sandbox.later(4)
    stage.keep("ticked")
    sandbox.key("ctrl+q")
    sandbox.ended()
    other = stage.start("hanging", config=sandbox.config)
    check(other.report()["handling"]["arrows"] == ["F", "F_b", "F_d", "F_g", "a", "v"], "the next session remembers them")


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
