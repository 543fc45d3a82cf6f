"""The mouse on the cloth where the window matters: strokes as they are seen, gusts, what the next session remembers."""

from cases import case, check, main
from sandbox import LEFT, centre


def apart(a, b):
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]))


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


def sphere_at_start(stage):
    """The scene `sphere`, paused at its start, where no cloth lies before the ball; and its report."""
    sandbox = stage.start("sphere")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.key("BackSpace")
    sandbox.wait(lambda r: r["steps"] == 0, "the restart")
    return sandbox, sandbox.later()


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


if __name__ == "__main__":
    main()
