"""A cloth at rest goes to sleep, costs next to nothing, and wakes when it is touched."""

import os
import time

from cases import case, check, main


def processor_time(sandbox):
    """s that the program has used so far."""
    with open(f"/proc/{sandbox.process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@case
def sleeps_and_wakes(stage):
    """a mat on the ground comes to rest and falls asleep: no more steps; a restart wakes it"""
    sandbox = stage.start("rubber_mat")
    report = sandbox.wait(lambda r: r["asleep"], "the cloth to fall asleep")
    check(not report["paused"] and report["steps"] > 1000, "it has been watched for a while")
    check(sandbox.later(4)["steps"] == report["steps"], "a sleeping cloth makes no steps")
    stage.keep("asleep")
    sandbox.key("r")
    sandbox.wait(lambda r: 0 < r["steps"] < report["steps"] and not r["asleep"], "the restart to wake it")


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
