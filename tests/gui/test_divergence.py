"""A cloth that explodes stops with a banner; restarting, and undoing what caused it, work."""

from cases import case, check, main
from sandbox import k_s


@case
def explodes(stage):
    """the preset that explodes stops, says when, where and why, and starts again from its banner"""
    sandbox = stage.start("explodes")
    report = sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")
    stage.keep("banner", still=True)
    why = report["divergence"]
    check(why["step"] == report["steps"] + 1, "the state is the one before the step that diverged")
    check(abs(why["t"] - why["step"] * report["preset"]["solver"]["dt"]) < 1e-6, "it tells the time of that step")
    check(why["cause"] and why["remedy"], "it tells the cause and the cure")
    later = sandbox.later(4)
    check((later["steps"], later["t"]) == (report["steps"], report["t"]), "it does not go on")
    sandbox.key("Right")
    check(sandbox.later()["steps"] == report["steps"], "nor by a single step")
    for mode in (5, 2, 1):
        sandbox.key(str(mode))
        sandbox.wait(lambda r: r["view"] == mode, "views to change all the same")
    check(sandbox.report()["paused"], "a step pauses")
    sandbox.click_control("viewport.Restart")
    report = sandbox.wait(lambda r: r["divergence"] is None, "the banner's button to restart")
    check(report["t"] == 0 and report["steps"] == 0, "the motion is at its start")
    check("viewport.Restart" not in sandbox.later()["controls"], "the banner is gone")
    sandbox.key("space")
    again = sandbox.wait(lambda r: r["divergence"] is not None, "it to diverge again")
    check(again["divergence"]["step"] == why["step"], "in the very same step")
    check(sandbox.process.poll() is None, "the program lives")


@case
def cure(stage):
    """the banner makes the change that it names, a second back: the cloth of the preset that explodes then moves on"""
    sandbox = stage.start("explodes")
    sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")
    sandbox.click_control("viewport.Verlet")
    report = sandbox.wait(lambda r: r["divergence"] is None, "the button to go back")
    check(report["preset"]["solver"]["integrator"] == "verlet" and report["unsaved"], "the integrator is Verlet")
    sandbox.wait(lambda r: r["t"] > 0.5 and r["divergence"] is None, "the cloth to move on")


@case
def own_doing(stage):
    """a slider pushed too far offers to undo that change and restart, which heals the cloth"""
    sandbox = stage.start("hanging")
    sandbox.type_value("k_s", "200000")
    sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")
    stage.keep("banner", still=True)
    sandbox.click_control("viewport.Undo_and_restart")
    report = sandbox.wait(lambda r: r["divergence"] is None, "the button to heal the cloth")
    check(k_s(report) == 50, "the change is undone")
    sandbox.wait(lambda r: r["t"] > 1 and r["divergence"] is None, "the cloth to move on for a second")


def pushed_over(stage):
    """A cloth that has run well for two seconds and then gets a dt too large for it."""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 2, "two seconds of motion")
    sandbox.type_value("dt", "0.004")
    return sandbox, sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")


@case
def rewound(stage):
    """after a divergence the past can be had back: paused, with the constants as they are"""
    sandbox, report = pushed_over(stage)
    sandbox.click_control("viewport.Rewind_1_s")
    back = sandbox.wait(lambda r: r["divergence"] is None, "the way back")
    check(back["t"] < report["t"] - 0.9, f"a second back, from {report['t']} to {back['t']}")
    check(back["paused"] and back["preset"]["solver"]["dt"] == 0.004, "paused, and nothing is changed")
    sandbox.type_value("dt", "0.001")
    sandbox.key("space")
    sandbox.wait(lambda r: r["t"] > report["t"] + 0.5 and r["divergence"] is None, "the cloth to move on")
    sandbox.key("space")
    later = sandbox.wait(lambda r: r["paused"], "the pause")["t"]
    sandbox.rest()
    sandbox.key("Left")
    sandbox.wait(lambda r: r["t"] < later - 0.5, "the key to go back a second")


@case
def smaller_step(stage):
    """the banner offers 0.9 of dt_crit, from a second back"""
    sandbox, report = pushed_over(stage)
    stage.keep("banner", still=True)
    name = next(n for n in sandbox.later()["controls"] if n.startswith("viewport.dt"))
    sandbox.click_control(name)
    back = sandbox.wait(lambda r: r["divergence"] is None, "the way back")
    check(0.0005 < back["preset"]["solver"]["dt"] < 0.002, "dt is one that Verlet can take")
    sandbox.wait(lambda r: r["t"] > report["t"] and r["divergence"] is None, "the cloth to move on")


@case
def implicit(stage):
    """the banner offers implicit Euler, which goes on with the same dt"""
    sandbox, report = pushed_over(stage)
    sandbox.click_control("viewport.Implicit_Euler")
    back = sandbox.wait(lambda r: r["divergence"] is None, "the way back")
    check(back["preset"]["solver"]["integrator"] == "implicit_euler", "with the other method")
    check(back["preset"]["solver"]["dt"] == 0.004, "and the same dt")
    sandbox.wait(lambda r: r["t"] > report["t"] and r["divergence"] is None, "the cloth to move on")


@case
def changed(stage):
    """once constants have changed, the banner says so and offers to try them instead of advice that is out of date"""
    sandbox = stage.start("explodes")
    report = sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")
    check(not report["divergence"]["constants_changed"], "nothing has changed yet")
    sandbox.type_value("k_s", "20")
    sandbox.wait(lambda r: r["divergence"]["constants_changed"], "the change to be noticed")
    report = sandbox.later(3)
    check("viewport.Verlet" not in report["controls"], "the advice for the old constants is gone")
    stage.keep("banner", still=True)
    sandbox.key("space")  # or the new constants may diverge too before anybody looks
    sandbox.click_control("viewport.Restart")
    report = sandbox.wait(lambda r: r["divergence"] is None, "the restart")
    check(k_s(report) == 20, "with the new constants")


@case
def extremes(stage):
    """extreme but allowed values stop the cloth at worst; the window goes on drawing and answering"""
    sandbox = stage.start("hanging")
    for key, value in (("k_s", "1e9"), ("k_d", "1e6"), ("g", "-100"), ("dt", "1"), ("k_b", "1e9")):
        sandbox.type_value(key, value)
    sandbox.wait(lambda r: r["divergence"] is not None, "the cloth to diverge")
    stage.keep("all-at-their-limits", still=True)
    sandbox.key("ctrl+shift+r")
    report = sandbox.wait(lambda r: r["divergence"] is None and not r["unsaved"], "everything to be reset")
    sandbox.wait(lambda r: r["steps"] > 50, "the cloth to move again")


if __name__ == "__main__":
    main()
