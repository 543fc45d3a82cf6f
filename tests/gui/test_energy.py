"""The energy ledger's card, and a dt that the program chooses."""

from cases import case, check, main
from sandbox import k_s


@case
def card(stage):
    """the card keeps the ledger while it is open: energy moves from height to motion and into damping"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["steps"] > 20, "the cloth to move")
    check(sandbox.report()["energy"] is None, "no ledger while nobody looks")
    sandbox.click_control("plots.Energy")
    sandbox.wait(lambda r: r["energy"] is not None, "the ledger to begin")
    report = sandbox.wait(lambda r: r["energy"] and r["energy"]["damping"] < -1e-4, "damping to take energy")
    check(abs(report["energy"]["share"]) < 0.01, "little is left unexplained")
    check(report["energy"]["wind"] == 0, "there is no wind")
    stage.keep("card")
    sandbox.type_value("k_s", "90")
    sandbox.wait(lambda r: k_s(r) == 90 and r["energy"]["edits"] != 0, "the edit to be told")
    sandbox.click_control("plots.Energy")
    sandbox.wait(lambda r: r["energy"] is None, "the ledger to end with the card")


@case
def method(stage):
    """what Euler makes of energy is seen, before it is a divergence"""
    sandbox = stage.start("hanging", "--integrator", "euler", "--dt", "0.00005")
    sandbox.key("space")
    sandbox.click_control("plots.Energy")
    sandbox.key("space")
    sandbox.wait(lambda r: r["energy"] and r["energy"]["share"] > 1e-4, "Euler to make energy")
    stage.keep("euler")


@case
def automatic(stage):
    """dt follows the constants while it is automatic, until it is typed"""
    sandbox = stage.start("hanging")
    sandbox.click_control("constants.auto")
    report = sandbox.wait(lambda r: r["auto_dt"], "dt to become automatic")
    before = report["preset"]["solver"]["dt"]
    sandbox.type_value("k_s", "5000")
    report = sandbox.wait(lambda r: r["preset"]["solver"]["dt"] < before / 5, "dt to follow k_s")
    at = report["t"]
    sandbox.wait(lambda r: r["t"] > at + 0.2 and r["divergence"] is None, "the cloth to move on")
    stage.keep("auto")
    sandbox.type_value("dt", "0.0001")
    report = sandbox.wait(lambda r: not r["auto_dt"], "the typed value to take over")
    check(report["preset"]["solver"]["dt"] == 0.0001, "it is taken")
    check(report["messages"], "and it is said")


@case
def no_stable_step(stage):
    """where a method has no stable dt, automatic says so and stays off"""
    sandbox = stage.start("hanging", "--integrator", "euler", "--set", "k_d=0", "--dt", "1e-5")
    sandbox.click_control("constants.auto")
    report = sandbox.wait(lambda r: r["messages"], "the reason")
    check(not report["auto_dt"] and report["preset"]["solver"]["dt"] == 1e-5, "nothing has changed")


if __name__ == "__main__":
    main()
