"""The cards that say how stable and how exact the present settings are."""

from cases import case, check, main


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


if __name__ == "__main__":
    main()
