"""Pause, single step, restart; no key press is lost, however long a frame takes."""

from cases import case, check, main


def paused(sandbox):
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "Space to pause")
    return sandbox.later()


@case
def pause_and_step(stage):
    """Space stops and starts the motion, → and O make exactly one step of dt"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["steps"] > 50, "the motion")
    report = paused(sandbox)
    steps, t, dt = report["steps"], report["t"], report["preset"]["solver"]["dt"]
    stage.keep("paused")
    later = sandbox.later(4)
    check((later["steps"], later["t"]) == (steps, t), "a pause that does not pause")
    for n, key in enumerate(("Right", "o", "Right"), 1):
        sandbox.key(key)
        report = sandbox.wait(lambda r: r["steps"] >= steps + n, f"{key} to step")
        report = sandbox.later(3)
        check(report["steps"] == steps + n, f"{key} made {report['steps'] - steps - n + 1} steps, not one")
        check(abs(report["t"] - t - n * dt) < 1e-9, f"a step of dt = {dt} took {report['t'] - t} s in all")
        check(report["paused"], "it is still paused")
    sandbox.click_control("top.step")
    sandbox.wait(lambda r: r["steps"] == steps + 4, "the button to step too")
    sandbox.key("space")
    sandbox.wait(lambda r: not r["paused"] and r["steps"] > steps + 50, "Space to start the motion again")
    sandbox.click_control("top.play")
    sandbox.wait(lambda r: r["paused"], "the button to pause too")


@case
def restart(stage):
    """Backspace and R restart the motion and keep the constants"""
    sandbox = stage.start("hanging", "--set", "k_s=80")
    for key in ("BackSpace", "r"):
        sandbox.wait(lambda r: r["steps"] > 100, "the motion")
        paused(sandbox)
        sandbox.key(key)
        report = sandbox.wait(lambda r: r["steps"] == 0, f"{key} to restart")
        check(report["t"] == 0 and report["preset"]["forces"]["k_s"] == 80, "t is 0 and k_s is kept")
        check(report["paused"], "a paused cloth stays paused")
        sandbox.key("space")
    stage.keep("restarted")


@case
def short_presses(stage):
    """thirty short key presses make thirty steps, though a frame takes long"""
    sandbox = stage.start("hanging", "--set", "rows=257", "--set", "columns=257", "--set", "L=0.004")
    steps = paused(sandbox)["steps"]
    sandbox.xdotool("key", "--delay", 4, *["Right"] * 30)
    sandbox.wait(lambda r: r["steps"] >= steps + 30, "thirty presses to make thirty steps")
    check(sandbox.later(3)["steps"] == steps + 30, "thirty presses made more than thirty steps")
    before = sandbox.report()["events"]
    sandbox.xdotool("key", "--delay", 4, *["space"] * 7)
    report = sandbox.wait(lambda r: r["events"] >= before + 7, "seven presses of Space")
    check(not report["paused"] and report["steps"] > steps + 30, "an odd number of presses starts the motion")


@case
def hold(stage):
    """→ held down goes on stepping, and stops when it is let go"""
    sandbox = stage.start("hanging")
    steps = paused(sandbox)["steps"]
    sandbox.xdotool("keydown", "Right")
    sandbox.wait(lambda r: r["steps"] > steps + 5, "the held key to repeat")
    sandbox.xdotool("keyup", "Right")
    report = sandbox.later(5)
    check(sandbox.later(4)["steps"] == report["steps"], "the key goes on after its release")


if __name__ == "__main__":
    main()
