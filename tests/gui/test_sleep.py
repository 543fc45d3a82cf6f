"""A cloth at rest goes to sleep, costs next to nothing, and wakes when it is touched."""

import os
import time

from cases import case, check, main
from sandbox import RIGHT, particle


def processor_time(sandbox):
    """s that the program has used so far."""
    with open(f"/proc/{sandbox.process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@case
def sleeps_and_wakes(stage):
    """without gravity a cloth rests and falls asleep: no more steps; a restart and the hand wake it"""
    sandbox = stage.start("hanging", "--set", "g=0", "--set", "rows=12", "--set", "columns=12",
                          "--set", "mode=5")
    report = sandbox.wait(lambda r: r["asleep"], "the cloth to fall asleep")
    check(not report["paused"] and report["steps"] > 1000, "it has been watched for a while")
    check(sandbox.later(4)["steps"] == report["steps"], "a sleeping cloth makes no steps")
    stage.keep("asleep")
    sandbox.key("r")
    sandbox.wait(lambda r: 0 < r["steps"] < report["steps"] and not r["asleep"], "the restart to wake it")
    report = sandbox.wait(lambda r: r["asleep"], "it to fall asleep again")
    sandbox.move(*particle(report, 5, 5)["at"])
    sandbox.press(RIGHT)
    report = sandbox.wait(lambda r: r["held"] and not r["asleep"], "the hand to wake it")
    sandbox.wait(lambda r: r["steps"] > report["steps"] + 50, "the motion")
    sandbox.release(RIGHT)


@case
def rests_cheaply(stage):
    """paused, with nobody watching over its shoulder, the program takes under 1 % of one core"""
    sandbox = stage.start("hanging", reported=False)
    sandbox.xdotool("key", "space")
    time.sleep(4)
    before, begun = processor_time(sandbox), time.monotonic()
    time.sleep(8)
    part = (processor_time(sandbox) - before) / (time.monotonic() - begun)
    check(part < 0.01, f"it took {100 * part:.1f} % of one core")


if __name__ == "__main__":
    main()
