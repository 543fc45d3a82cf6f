"""The five views look as they should, in the window's own pixels."""

import statistics

from cases import case, check, main
from screen import distance

NAMES = {1: "triangles", 2: "connections", 3: "both", 4: "outlines", 5: "points"}


def covered(picture):
    """The part of the pixels that are not the smooth background, seen as a stripe of the same colour from top to bottom
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
    sandbox = stage.start("hanging", "--set", "rows=13", "--set", "columns=13", "--set", "L=0.08", "--set", "texture=linen.png",
                          effects="all")
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


@case
def views(stage):
    """triangles cover the cloth, connections more of it than outlines, and points least"""
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
    for a in (1, 2, 4, 5):
        for b in (1, 2, 4, 5):
            check(a == b or cloth[a].differs_from(cloth[b]) > 0.005, f"views {a} and {b} differ")
    again = show(sandbox, stage, 1).crop(viewport_below_buttons(viewport))
    check(again.differs_from(cloth[1]) < 0.001, "view 1 comes back as it was")


def viewport_below_buttons(viewport):
    x, y, width, height = viewport
    return x + 8, y + 50, width - 16, height - 60


@case
def torn(stage):
    """where the cloth is cut, view 1 has a hole and view 3 shows the connections that are left"""
    sandbox, report = coarse(stage)
    whole = show(sandbox, stage, 1, "whole")
    a, b = report["particles"][11]["at"], report["particles"][13]["at"]
    sandbox.drag([a, b])
    sandbox.wait(lambda r: r["torn_springs"] > 5, "the cut")
    box = (a[0], a[1] - 60, b[0] - a[0], 60)
    cut = {mode: show(sandbox, stage, mode, "torn").crop(box) for mode in (1, 2, 3)}
    check(cut[1].differs_from(whole.crop(box), 24) > 0.3, "the cut is seen as a hole in view 1")
    check(cut[3].differs_from(cut[1]) > 0.01, "view 3 shows connections in the hole")
    check(cut[3].differs_from(cut[2]) > 0.1, "view 3 still shows triangles where view 2 has connections")


@case
def buttons(stage):
    """the buttons over the cloth choose the views as the keys do; Tab hides the panels and brings them back"""
    sandbox, report = coarse(stage)
    for mode in (4, 2, 1):
        sandbox.click_control(f"viewport.views.{mode}")
        sandbox.wait(lambda r: r["view"] == mode, f"the button of view {mode}")
    sandbox.key("Tab")
    wide = sandbox.wait(lambda r: r["viewport"][2] == r["window"][0], "Tab to hide the panels")
    check("constants.k_s.slider" not in wide["controls"], "no constants are drawn")
    stage.keep("hidden-panels", still=True)
    sandbox.key("Tab")
    sandbox.wait(lambda r: r["viewport"] == report["viewport"], "Tab to bring the panels back")
    sandbox.key("F1")
    sandbox.later(4)
    stage.keep("help")
    sandbox.key("Escape")
    check(not sandbox.later()["unsaved"], "a view is no change of the preset")


if __name__ == "__main__":
    main()
