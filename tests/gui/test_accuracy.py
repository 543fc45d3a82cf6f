"""The cards that say how stable and how exact the present settings are."""

from cases import case, check, main
from sandbox import k_s


@case
def error(stage):
    """the accuracy card measures the present settings beside the frames, anew when a constant changes"""
    sandbox = stage.start("hanging")
    check(sandbox.report()["accuracy"] is None, "nothing is measured while nobody looks")
    sandbox.click_control("plots.Accuracy")
    report = sandbox.wait(lambda r: r["accuracy"] and r["accuracy"]["error_rms_m"], "the error to be measured")
    check(0 < report["accuracy"]["error_rms_m"] < 1e-3, "verlet is good to a millimetre")
    check(report["t"] > 0 and not report["paused"], "the cloth moves on")
    sandbox.wait(lambda r: r["accuracy"]["points"] > 3, "other methods beside it")
    stage.keep("card")
    sandbox.type_value("dt", "0.0001")
    sandbox.wait(lambda r: r["accuracy"] and (r["accuracy"]["error_rms_m"] or 1) < 2e-6, "the error of a tenth of dt")
    sandbox.click_control("plots.Accuracy")
    sandbox.wait(lambda r: r["accuracy"] is None, "the work to end with the card")


@case
def convergence(stage):
    """the other side of the accuracy card measures the order beside the frames, and writes it as CSV"""
    sandbox = stage.start("taut_sheet", "--integrator", "rk4", "--set", "rows=9", "--set", "columns=9")
    sandbox.key("space")  # while nothing moves the frames leave the processors to what is measured
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette")
    sandbox.type("order of conv")
    sandbox.later(3)
    sandbox.key("Return")
    report = sandbox.wait(lambda r: r["convergence"] and r["convergence"]["done"], "the order to be measured")
    check(report["convergence"]["points"] == 5, "dt to dt/16")
    check(report["convergence"]["order"] is not None, "an order")
    check(report["accuracy"] is None, "the card's other side rests")
    stage.keep("convergence", still=True)
    sandbox.click_control("plots.csv_convergence")
    file = sandbox.write_export("convergence.csv")
    with open(file) as written:
        lines = written.read().splitlines()
    check(lines[1] == "dt [s],error [m],difference to dt/2 [m],status" and len(lines) == 7, "a row for each dt")
    sandbox.click_control("plots.accuracy_ways.1")
    sandbox.wait(lambda r: r["convergence"] is None and r["accuracy"], "the errors to come back")


@case
def stability(stage):
    """the stability card marks the cloth's fastest mode on the method's growth, and follows k_s"""
    sandbox = stage.start("hanging")
    sandbox.click_control("plots.Stability")
    sandbox.wait(lambda r: r["dt_over_limit"] is not None, "the limits")
    stage.keep("card")
    sandbox.type_value("k_s", "110")
    sandbox.wait(lambda r: k_s(r) == 110 and r["dt_over_limit"] and r["dt_over_limit"] > 1, "the limit to move")
    stage.keep("stiffer")


@case
def tab(stage):
    """a card that has no room under the plots becomes a tab beside them, and goes back to its place when it is folded"""
    sandbox = stage.start("hanging")
    headings = {"plots." + name for name in ("Copies", "Stability", "Accuracy", "Energy", "Performance")}
    check("plots.cards" not in sandbox.report()["controls"], "no tabs while all are folded")
    for name in ("Stability", "Energy"):
        sandbox.click_control("plots." + name)
        report = sandbox.wait(lambda r: "plots.cards" in r["controls"], "the tabs")
        stage.keep(name)
    report = sandbox.later(4)
    check(report["energy"] is not None, "the one that was opened last is shown, and its ledger kept")
    check(headings - set(report["controls"]) == {"plots.Stability"}, "the headings stay but of the one behind the other")
    sandbox.click_control("plots.Energy")
    sandbox.wait(lambda r: "plots.Stability" in r["controls"] or r["energy"] is None, "Energy to be folded")
    report = sandbox.later(4)
    check("plots.cards" in report["controls"] and report["energy"] is None, "Stability is a tab still")


if __name__ == "__main__":
    main()
