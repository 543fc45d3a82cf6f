"""Pictures: what the window's own pixels show of the cloth, its colors, effects and themes; pictures that it writes."""

import itertools
import os
import statistics

from cases import case, check, main
from screen import Picture, distance

NAMES = {1: "triangles", 2: "connections", 3: "both", 4: "outlines", 5: "points"}


def covered(picture):
    """The part of the pixels that are not the smooth background, seen as a stripe of the same color from top to bottom
    of a small box: a pixel counts that differs from the median of its row."""
    count = 0
    for y in range(picture.height):
        row = picture.row(y)
        ground = tuple(statistics.median_low([pixel[k] for pixel in row]) for k in range(3))
        count += sum(distance(pixel, ground) > 10 for pixel in row)
    return count / (picture.width * picture.height)


def show(sandbox, stage, mode, name=None):
    """Goes to a view by its key and returns the whole picture, once it stands still."""
    sandbox.key(str(mode))
    sandbox.wait(lambda r: r["view"] == mode, f"the key {mode} to choose the view")
    sandbox.rest()
    return stage.keep(f"{name or 'view'}-{mode}-{NAMES[mode]}", still=True)


def coarse(stage):
    """A paused cloth with wide meshes, free of the picked particle's ring and arrows: nothing is picked."""
    sandbox = stage.start("hanging", "--set", "rows=13", "--set", "columns=13", "--set", "L=0.08",
                          "--set", "texture=linen.png", effects="all")
    sandbox.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    report = sandbox.later()
    x, y, width, height = report["viewport"]
    sandbox.click(x + 30, y + height - 30, 3)
    sandbox.wait(lambda r: r["picked"] is None, "a right click beside the cloth to pick nothing")
    return sandbox, report


def inside(report):
    """A box within the cloth, a quarter of the way from its edges."""
    at = [report["particles"][k]["at"] for k in (6, 8, 16, 18)]
    left, right = max(at[0][0], at[2][0]), min(at[1][0], at[3][0])
    top, bottom = max(at[0][1], at[1][1]), min(at[2][1], at[3][1])
    return left, top, right - left, bottom - top


def viewport_below_buttons(viewport):
    x, y, width, height = viewport
    return x + 8, y + 90, width - 16, height - 100  # the mark of a pause may stand in a row of its own


@case
def views(stage):
    """triangles cover the cloth, connections more of it than outlines, and points least; a cut is a hole"""
    sandbox, report = coarse(stage)
    pictures = {mode: show(sandbox, stage, mode) for mode in NAMES}
    box, viewport = inside(report), report["viewport"]
    lines = {mode: covered(pictures[mode].crop(box)) for mode in (2, 4, 5)}
    check(lines[2] > 1.1 * lines[4], f"connections have a diagonal more than outlines: {lines}")
    check(lines[4] > 1.5 * lines[5] > 0.02, f"points cover least, and something: {lines}")
    check(lines[2] < 0.6, f"one sees through the connections: {lines}")
    empty = pictures[5].crop(box)
    for mode in (1, 3):
        part = pictures[mode].crop(box).differs_from(empty, 24)
        check(part > 0.95, f"triangles hide the background in view {mode}: {part:.2f} of it")
    cloth = {mode: pictures[mode].crop(viewport_below_buttons(viewport)) for mode in NAMES}
    check(cloth[1].differs_from(cloth[3]) < 0.001, "views 1 and 3 are the same while nothing is torn")
    for a, b in itertools.combinations((1, 2, 4, 5), 2):
        check(cloth[a].differs_from(cloth[b]) > 0.005, f"views {a} and {b} differ")
    whole = show(sandbox, stage, 1, "whole")
    check(whole.crop(viewport_below_buttons(viewport)).differs_from(cloth[1]) < 0.001, "view 1 comes back as it was")
    a, b = report["particles"][11]["at"], report["particles"][13]["at"]
    sandbox.drag([a, b])
    sandbox.wait(lambda r: r["torn_springs"] > 5, "the cut")
    box = (a[0], a[1] - 60, b[0] - a[0], 60)
    cut = {mode: show(sandbox, stage, mode, "torn").crop(box) for mode in (1, 2, 3)}
    check(cut[1].differs_from(whole.crop(box), 24) > 0.3, "the cut is seen as a hole in view 1")
    check(cut[3].differs_from(cut[1]) > 0.01, "view 3 shows connections in the hole")
    check(cut[3].differs_from(cut[2]) > 0.1, "view 3 still shows triangles where view 2 has connections")


def paused(stage, *arguments):
    """A cloth that has fallen for a moment and stands still."""
    sandbox = stage.start("hanging", *arguments)
    sandbox.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.rest()
    return sandbox


def write(sandbox, dialog, name):
    """In a dialog that asks for a file: has the picture written into the own folder, and returns it."""
    sandbox.wait(lambda r: r["dialog"] == dialog and r["typing"], "the dialog to take keys")
    file = os.path.join(sandbox.own.name, name)
    sandbox.key("ctrl+a")
    sandbox.type(file)
    sandbox.later(3)
    sandbox.key("Return")
    sandbox.wait(lambda r: r["dialog"] == "none" and any(name in m for m in r["messages"]), "the picture to be written")
    return Picture.read(file)


def save(sandbox, name, whole=False):
    """Saves a picture by Ctrl+Shift+P; returns it."""
    sandbox.key("ctrl+shift+p")
    sandbox.wait(lambda r: r["dialog"] == "picture", "the dialog")
    if whole:
        sandbox.click_control("dialog.parts.2")
        sandbox.click_control("dialog.path")
    return write(sandbox, "picture", name)


@case
def saved(stage):
    """Ctrl+Shift+P saves the cloth with its legend and without buttons, or the whole window; the map is saved too"""
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
    sandbox.key("m")
    sandbox.wait(lambda r: r["map_cells"], "the map's first cells")
    sandbox.rest()
    left_of_cloth = (0, 0, x, height)  # the map goes on filling at the right
    before = stage.keep("before-the-map", left_of_cloth).crop(left_of_cloth)
    sandbox.click_control("plots.png_map")
    page = write(sandbox, "write_export", "map.png")
    page.save(os.path.join(stage.shots, f"{stage.name}-map.png"))
    check((page.width, page.height) == (1280, 800), "it is of the charts' size")
    sandbox.rest()
    check(stage.keep("after-the-map", left_of_cloth).crop(left_of_cloth) == before, "the window is drawn as before")


@case
def effects(stage):
    """few effects are drawn where that is wished, and all where that is"""
    few = stage.start("sphere", effects="few")  # with a plane for shadows to fall on
    report = few.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    check(report["effects_left_out"] == 3, "three effects are left out")
    few.key("space")
    few.rest()
    plain = stage.keep("few", still=True)
    few.find("full quality")
    few.wait(lambda r: r["effects_left_out"] == 0, "the palette to bring all back")
    few.rest()
    x, y, width, height = report["viewport"]
    part = (x + 8, y + 120, width - 16, height - 130)
    check(stage.keep("all", still=True).crop(part).differs_from(plain.crop(part), 12) > 0.01, "they are seen")


@case
def themes(stage):
    """Ctrl+T goes through the themes; the last one is there again in the next session"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.4, "the cloth to hang")
    check(sandbox.report()["theme"] == "dark", "dark at first")
    sandbox.key("ctrl+t")
    sandbox.wait(lambda r: r["theme"] == "light", "light")
    sandbox.rest()
    light = stage.keep("light")
    check(sum(light.pixel(5, 400)) > 600, "the panels are light")
    sandbox.key("ctrl+t")
    sandbox.wait(lambda r: r["theme"] == "projector", "projector")
    sandbox.later(10)
    stage.keep("projector")
    sandbox.key("ctrl+q")
    check(sandbox.ended() == 0, "it ends well")
    again = stage.start("hanging", config=sandbox.config)
    check(again.report()["theme"] == "projector", "the theme is remembered")
    again.key("ctrl+t")
    again.wait(lambda r: r["theme"] == "dark", "round to dark")


if __name__ == "__main__":
    main()
