"""Colouring the cloth: by key; what is written of it."""

import csv

from cases import case, check, main


def paused(stage, *arguments):
    """A cloth that has fallen for a moment and stands still."""
    sandbox = stage.start("hanging", *arguments)
    sandbox.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.rest()
    return sandbox


def middle(report):
    """A box in the middle of the cloth's picture."""
    at = [report["particles"][k]["at"] for k in (6, 18)]
    return at[0][0], at[0][1], at[1][0] - at[0][0], at[1][1] - at[0][1]


@case
def keys(stage):
    """K goes through what can colour the cloth and back to its own look, which is as it was"""
    sandbox = paused(stage)
    report = sandbox.report()
    box = middle(report)
    plain = stage.keep("own", still=True)
    check(report["colors"] is None, "nothing colours the cloth at first")
    last = plain
    for name in ("tension", "strain", "speed", "kinetic"):
        sandbox.key("k")
        report = sandbox.wait(lambda r: r["colors"] and r["colors"]["field"] == name, f"K to colour by {name}")
        check(report["colors"]["top"] > 0, "a scale")
        picture = stage.keep(name, still=True)
        check(picture.crop(box).differs_from(last.crop(box), 10) > 0.3, f"{name} looks other than what was before")
        last = picture
    sandbox.key("k")
    sandbox.wait(lambda r: r["colors"] is None, "K to come back to the cloth's own look")
    again = stage.keep("own-again", still=True)
    x, y, width, height = report["viewport"]
    part = (x + 8, y + 80, width - 16, height - 90)
    # The arrows' length follows slowly, by less than a step of colour; the cloth's own pixels are held to the byte by
    # tests/app/color_test.cpp.
    check(again.crop(part).differs_from(plain.crop(part), 3) == 0, "not a pixel of it has changed")


@case
def values(stage):
    """every particle's values are written as CSV from the palette"""
    sandbox = paused(stage)
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette")
    sandbox.type("particle's values")
    sandbox.later(3)
    sandbox.key("Return")
    file = sandbox.write_export("values.csv")
    with open(file) as written:
        next(written)
        rows = list(csv.DictReader(written))
    check(len(rows) == 32 * 32, "a row per particle")
    check(set(rows[0]) == {"i", "j", "tension [N]", "strain", "speed [m/s]", "kinetic [J]"}, f"columns with units: {rows[0]}")
    check(float(rows[0]["tension [N]"]) > 0 and float(rows[0]["speed [m/s]"]) == 0, "the pinned corner holds and rests")


@case
def mesh(stage):
    """Ctrl+E writes the cloth as OBJ, and the palette the state, as the cloth stands"""
    sandbox = paused(stage)
    sandbox.key("ctrl+e")
    with open(sandbox.write_export("cloth.obj")) as written:
        lines = [line.split() for line in written]
    count = {word: sum(line[0] == word for line in lines) for word in ("v", "vt", "vn", "f")}
    check(count == {"v": 1024, "vt": 1024, "vn": 1024, "f": 2 * 31 * 31}, f"the mesh has {count}")
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette")
    sandbox.type("export state")
    sandbox.later(3)
    sandbox.key("Return")
    with open(sandbox.write_export("state.csv")) as written:
        head = next(written)
        rows = list(csv.DictReader(written))
    at = float(head.split("t = ")[1].split(",")[0])
    check(abs(at - sandbox.report()["t"]) < 1e-6, f"the state says when it was: {head}")
    corner = [float(rows[-1][c]) for c in "xyz"]
    meshed = [float(word) for word in lines[[line[0] for line in lines].index("v") + 1023][1:]]
    check(all(abs(a - b) < 1e-6 for a, b in zip(corner, meshed)), f"{corner} in the state, {meshed} in the mesh")
    sandbox.close()
    weight = stage.start("one_weight")
    weight.key("ctrl+e")
    weight.wait(lambda r: any("mass on a spring" in m for m in r["messages"]), "the reason why a weight is no mesh")
    check(weight.later()["dialog"] == "none", "and no dialog")


if __name__ == "__main__":
    main()
