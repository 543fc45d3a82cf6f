"""A step of the picked particle, written out."""

from cases import case, check, main
from sandbox import centre


@case
def step(stage):
    """paused, the next step is written out; → makes it, and it comes out as foretold"""
    sandbox = stage.start("hanging", "--precision", "double")
    sandbox.wait(lambda r: r["steps"] > 60, "the cloth to move")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "it to pause")
    sandbox.key("i")
    report = sandbox.wait(lambda r: r["inside"] is not None, "the step to be written out")
    check(report["inside"]["site"] == report["picked"], "that of the picked particle")
    check(report["inside"]["evaluations"] == 1 and report["inside"]["springs"] == 12, "Verlet looks once, at 12 springs")
    foretold = report["inside"]["x"]
    sandbox.rest()
    stage.keep("verlet")
    before = report["steps"]
    sandbox.key("Right")
    report = sandbox.wait(lambda r: r["steps"] == before + 1, "the step")
    apart = max(abs(a - b) for a, b in zip(report["picked_x"], foretold))
    check(apart < 1e-12, f"it comes out as foretold, not {apart} m beside it")
    check(report["inside"]["x"] != foretold, "and the next one")
    sandbox.move(*centre(sandbox.control("plots.close_inside")))
    sandbox.click_control("plots.close_inside")
    sandbox.wait(lambda r: r["inside"] is None, "the card to close")


@case
def stages(stage):
    """every evaluation of Runge-Kutta's step is told"""
    sandbox = stage.start("hanging", "--integrator", "rk4")
    sandbox.key("i")
    sandbox.wait(lambda r: r["inside"] and r["inside"]["evaluations"] == 4, "four evaluations")
    sandbox.key("space")
    stage.keep("rk4")


if __name__ == "__main__":
    main()
