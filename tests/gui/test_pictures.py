"""Pictures: saved from the window, and drawn with fewer effects where that is slow."""

import os

from cases import case, check, main
from screen import Picture


def save(sandbox, name, whole=False):
    """Saves a picture by Ctrl+Shift+P; returns it."""
    sandbox.key("ctrl+shift+p")
    sandbox.wait(lambda r: r["dialog"] == "picture" and r["typing"], "the dialog")
    if whole:
        sandbox.click_control("dialog.parts.2")
        sandbox.click_control("dialog.path")
    file = os.path.join(sandbox.own.name, name)
    sandbox.key("ctrl+a")
    sandbox.type(file)
    sandbox.later(3)
    sandbox.key("Return")
    sandbox.wait(lambda r: r["dialog"] == "none" and any(name in m for m in r["messages"]), "the picture to be written")
    return Picture.read(file)


@case
def saved(stage):
    """Ctrl+Shift+P saves the cloth with its legend and without buttons, or the whole window"""
    sandbox = stage.start("hanging", "--color", "tension")
    sandbox.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    report = sandbox.later()
    x, y, width, height = report["viewport"]
    cloth = save(sandbox, "cloth.png")
    cloth.save(os.path.join(stage.shots, f"{stage.name}-cloth.png"))
    check((cloth.width, cloth.height) == (width, height), "it is as large as the viewport")
    shown = stage.keep("shown").crop((x, y, width, height))
    left, top, wide, high = report["marks"]["legend"]
    legend = (left - x, top - y, wide, high)
    check(cloth.crop(legend).differs_from(shown.crop(legend), 12) < 0.02, "with the legend as it is shown")
    buttons = (16, 12, 200, 26)
    check(cloth.crop(buttons).differs_from(shown.crop(buttons), 12) > 0.3, "and without the buttons")
    whole = save(sandbox, "window.png", whole=True)
    check([whole.width, whole.height] == report["window"], "or it is the whole window")


@case
def effects(stage):
    """few effects are drawn where that is wished, and all where that is"""
    few = stage.start("hanging", effects="few")
    report = few.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    check(report["effects_left_out"] == 3, "three effects are left out")
    few.key("space")
    few.rest()
    plain = stage.keep("few", still=True)
    few.key("ctrl+p")
    few.wait(lambda r: r["palette"] and r["typing"], "the palette")
    few.type("all effects")
    few.later(3)
    few.key("Return")
    few.wait(lambda r: r["effects_left_out"] == 0, "the palette to bring all back")
    few.rest()
    x, y, width, height = report["viewport"]
    part = (x + 8, y + 120, width - 16, height - 130)
    check(stage.keep("all", still=True).crop(part).differs_from(plain.crop(part), 12) > 0.01, "they are seen")


if __name__ == "__main__":
    main()
