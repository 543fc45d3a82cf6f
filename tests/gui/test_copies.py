"""Copies that move in lockstep beside the cloth: the same hand, different settings."""

from cases import case, check, main
from sandbox import RIGHT, centre, k_s, particle


def add(sandbox, item):
    """Adds a copy with an item of the card's menu."""
    sandbox.click_control("plots.add")
    sandbox.click_control("menu." + item)


@case
def lockstep(stage):
    """equal copies stay equal under the hand; another method parts from them; all are seen beside each other"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    sandbox.click_control("plots.Copies")
    add(sandbox, "Equal_copy")
    report = sandbox.wait(lambda r: len(r["copies"]) == 1, "the equal copy")
    check(report["pictures"] == [1, 2] or report["pictures"] == [2, 1], "two pictures")
    add(sandbox, "Implicit_Euler")
    report = sandbox.wait(lambda r: len(r["copies"]) == 2, "implicit Euler beside them")
    sandbox.key("space")
    report = sandbox.wait(lambda r: r["steps"] > 100 and r["copies"][1]["distance"], "the copies to move")
    check(report["copies"][0]["steps"] == report["steps"], "the equal copy makes the same steps")
    check(report["copies"][0]["distance"] == 0, "the equal copy is where the original is")
    check(report["copies"][1]["distance"] > 1e-6, "implicit Euler is not")
    sandbox.key("space")  # a swinging corner would be gone before the pointer comes
    sandbox.wait(lambda r: r["paused"], "all to pause")
    report = sandbox.later(4)
    at = particle(report, report["preset"]["cloth"]["rows"] - 1, 0)["at"]
    sandbox.move(*at)
    sandbox.press(RIGHT)
    sandbox.move(at[0] + 30, at[1] - 20)
    report = sandbox.wait(lambda r: r["held"] is not None, "the hand to take the original")
    for copy in report["copies"]:
        check(copy["held"] == [report["held"]["i"], report["held"]["j"]], "the hand takes the copies too")
    sandbox.key("space")
    sandbox.wait(lambda r: not r["paused"], "all to go on")
    sandbox.move(at[0] + 80, at[1] - 60)
    sandbox.later(8)
    stage.keep("held")
    sandbox.release(RIGHT)
    report = sandbox.later(10)
    check(report["copies"][0]["distance"] == 0, "equal copies stay equal under the hand")
    sandbox.click_control("plots.remove1")
    sandbox.click_control("plots.remove0")
    report = sandbox.wait(lambda r: not r["copies"], "the copies to be gone")
    check(report["pictures"] == [1, 1], "one picture again")


@case
def constant(stage):
    """a constant's own menu adds a copy that keeps its value; the original's other constants reach it"""
    sandbox = stage.start("hanging")
    x, y = centre(sandbox.control("constants.k_s.value"))
    sandbox.click(x, y, RIGHT)
    sandbox.click_control("menu.copy_double")
    report = sandbox.wait(lambda r: len(r["copies"]) == 1, "the copy")
    name = report["copies"][0]["name"]
    check(name == f"k_s = {2 * k_s(report):g}", f"it is called by its difference, not {name}")
    sandbox.type_value("k_s", "60")
    sandbox.wait(lambda r: k_s(r) == 60 and r["copies"][0]["name"] == name, "the original alone to change")
    sandbox.click(x, y, RIGHT)
    sandbox.click_control("menu.copy_value")
    sandbox.type("25")
    sandbox.key("Return")
    sandbox.wait(lambda r: len(r["copies"]) == 2 and r["copies"][1]["name"] == "k_s = 25", "the typed value")
    sandbox.wait(lambda r: r["t"] > 0.6, "them to part")
    sandbox.rest()
    stage.keep("three")
    sandbox.click_control("plots.ways")
    x, y, width, height = sandbox.control("plots.ways")
    sandbox.click(x + width - 10, y + height / 2)
    sandbox.wait(lambda r: r["pictures"] == [1, 1], "one picture, overlaid")
    sandbox.later(5)
    stage.keep("overlaid")


@case
def divergence(stage):
    """a copy that diverges is told so in its picture while the others go on, and a restart mends it"""
    sandbox = stage.start("hanging")
    sandbox.click_control("plots.Copies")
    add(sandbox, "Euler")
    report = sandbox.wait(lambda r: r["copies"] and r["copies"][0]["diverged"], "Euler to diverge")
    at = report["t"]
    check(report["divergence"] is None, "the original does not")
    sandbox.wait(lambda r: r["t"] > at + 0.2, "the original to go on")
    stage.keep("euler")
    sandbox.key("space")
    sandbox.key("r")
    sandbox.wait(lambda r: r["t"] < at and not r["copies"][0]["diverged"], "all to begin anew")


@case
def original_diverges(stage):
    """where the original diverges its copies go on"""
    sandbox = stage.start("hanging", "--integrator", "euler")
    sandbox.key("space")
    sandbox.click_control("plots.Copies")
    add(sandbox, "Verlet")
    sandbox.wait(lambda r: len(r["copies"]) == 1, "the copy")
    sandbox.key("r")
    sandbox.key("space")
    report = sandbox.wait(lambda r: r["divergence"] is not None, "Euler to diverge")
    at = report["copies"][0]["t"]
    sandbox.wait(lambda r: r["copies"][0]["t"] > at + 0.3, "Verlet to go on")
    stage.keep("banner")


if __name__ == "__main__":
    main()
