"""A window in which nothing moves costs next to nothing."""

import os
import time

from cases import case, check, main
from sandbox import PATIENCE


def processor_time(sandbox):
    """s that the program has used so far."""
    with open(f"/proc/{sandbox.process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def part_of_a_core(sandbox, seconds):
    before, begun = processor_time(sandbox), time.monotonic()
    time.sleep(seconds)
    return (processor_time(sandbox) - before) / (time.monotonic() - begun)


@case
def rests_cheaply(stage):
    """paused, with nobody watching over its shoulder, the program takes under 1 % of one core"""
    sandbox = stage.start("hanging", reported=False)
    check(part_of_a_core(sandbox, 1) > 0.01, "the cloth moves, and that is seen")
    sandbox.xdotool("key", "space")
    end = time.monotonic() + PATIENCE
    while (part := part_of_a_core(sandbox, 3)) >= 0.01:  # at first what fades and what was begun comes to its end
        check(time.monotonic() < end, f"it takes {100 * part:.1f} % of one core")


if __name__ == "__main__":
    main()
