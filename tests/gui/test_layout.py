"""Cards at the right that have little room: tabs, scrolling, commands that open them; and the cloth in its picture."""

import json
import os

from cases import case, check, main

CARDS = ["Copies", "Stability", "Accuracy", "Energy", "Performance"]


def start(stage, preset, scale=1, theme="dark", size=(1280, 720)):
    config = os.path.join(stage.shots, f"config-{stage.name}-{len(stage.sandboxes)}")
    os.makedirs(config, exist_ok=True)
    with open(os.path.join(config, "settings.json"), "w") as file:
        json.dump({"window": {"x": 0, "y": 0, "width": size[0], "height": size[1]}, "ui_scale": scale, "theme": theme,
                   "tour_seen": True}, file)
    return stage.start(preset, size=size, config=config)


def find(sandbox, text):
    """Does what the palette finds first."""
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette")
    sandbox.later(3)
    sandbox.type(text)
    sandbox.later(4)
    sandbox.key("Return")
    sandbox.wait(lambda r: not r["palette"], "the palette to close")
    return sandbox.later(4)


def choose_tab(sandbox, name):
    """By its tab, or in the list of tabs."""
    report = sandbox.later(4)
    place = report["tabs"].index(name) + 1
    if f"plots.cards.{place}" in report["controls"]:
        sandbox.click_control(f"plots.cards.{place}")
    else:
        sandbox.click_control("plots.cards")
        sandbox.click_control("menu." + name)
    return sandbox.later(4)


def whole(report, name, height):
    """Whether a control is there, within the window, and at least so high."""
    if name not in report["controls"]:
        return False
    x, y, w, h = report["controls"][name]
    return h >= height and x >= 0 and x + w <= report["window"][0] + 1 and y + h <= report["window"][1] + 1


def check_in_picture(report, what, rows=None):
    """The sampled particles stand in the (first) picture, below the buttons."""
    x, y, width, height = report["viewport"]
    across, down = report["pictures"]
    top = y + report["view_buttons"]
    for p in report["particles"]:
        if rows is not None and p["i"] not in rows:
            continue
        px, py = p["at"]
        check(x <= px <= x + width / across and top - 1 <= py <= y + height / down,
              f"{what}: particle ({p['i']}, {p['j']}) at {px:.0f}, {py:.0f} is not within the picture {x}, {top}, "
              f"{width / across}, {height / down}")


@case
def small(stage):
    """with large text the plots keep a height at which they are read, and the column scrolls"""
    for scale, theme in ((2, "dark"), (2.6, "dark"), (1.5, "projector")):
        sandbox = start(stage, "hanging", scale, theme)
        find(sandbox, "forces card")
        stage.keep(f"forces-{scale}-{theme}")
        sandbox.scroll_to("plots.force_plot", "plots.source.1")
        stage.keep(f"forces-{scale}-{theme}-curves")
        check(whole(sandbox.report(), "plots.force_plot", 60), f"the curves have height at {scale}")
        sandbox.scroll_to("plots.curve.F_ext", "plots.force_plot")
        stage.keep(f"forces-{scale}-{theme}-legend")
        sandbox.key("m")
        sandbox.wait(lambda r: r["tab"] == "Map", "the map")
        sandbox.later(4)
        report = sandbox.report()
        if "plots.map" not in report["controls"]:
            sandbox.scroll_to("plots.map", "plots.close_map")
        check(whole(sandbox.later(4), "plots.map", 60), "the map has height")
        stage.keep(f"map-{scale}-{theme}")
        sandbox.close()


@case
def tabs(stage):
    """every card is reached by its tab, which unfolds it, and by the palette"""
    for scale, size in ((1.5, (1280, 720)), (2.6, (1280, 720))):
        sandbox = start(stage, "hanging", scale, size=size)
        sandbox.key("m")
        sandbox.key("i")
        report = find(sandbox, "forces card")
        for name in [n for n in CARDS if n in report["tabs"]] + ["Map", "Step", "Forces"]:
            if name not in sandbox.report()["tabs"]:
                continue
            choose_tab(sandbox, name)
            sandbox.wait(lambda r: r["tab"] == name, f"the tab {name}")
        stage.keep(f"tabs-{scale}")
        for name in CARDS:
            find(sandbox, f"{name} card")
            report = sandbox.later(4)
            check(name not in report["tabs"] or report["tab"] == name, f"the palette brings {name} to the front")
            check("plots." + name in report["controls"], f"{name} is in sight")
            if name == "Energy":
                check(report["energy"] is not None, "the card is open")
            stage.keep(f"{name}-{scale}")
        sandbox.close()


@case
def unfolds(stage):
    """a tab that is clicked shows what its card holds; folding it goes back to the plots"""
    sandbox = start(stage, "hanging", 2)
    find(sandbox, "forces card")
    check("Energy" in sandbox.report()["tabs"], "Energy is a tab")
    choose_tab(sandbox, "Energy")
    sandbox.wait(lambda r: r["energy"] is not None, "the ledger")
    stage.keep("energy")
    choose_tab(sandbox, "Accuracy")
    sandbox.wait(lambda r: r["accuracy"] is not None, "the errors")
    stage.keep("accuracy")
    sandbox.click_control("plots.Accuracy")
    sandbox.wait(lambda r: "plots.force_plot" in r["controls"], "the forces, once it is folded")


@case
def copies(stage):
    """Copies are a tab where they have no room, and its button is reached with none and with four of them"""
    for scale, theme in ((1, "projector"), (2, "light")):
        sandbox = start(stage, "flag", scale, theme)
        sandbox.key("space")
        sandbox.key("m")
        sandbox.key("i")
        find(sandbox, "copies card")
        for count in range(1, 5):
            report = sandbox.report()
            if "Copies" in report["tabs"] and report["tab"] != "Copies":
                choose_tab(sandbox, "Copies")
            x, y, width, height = sandbox.control("plots.add")
            check(height >= 29 * scale, f"the button is seen whole, not {height} high")
            stage.keep(f"{theme}-{scale}-{count - 1}")
            sandbox.click_control("plots.add")
            sandbox.click_control("menu.Equal_copy")
            sandbox.wait(lambda r: len(r["copies"]) == count, "the copy")
            sandbox.later(4)
        if "plots.add" not in sandbox.report()["controls"]:
            choose_tab(sandbox, "Copies")
        if "plots.add" not in sandbox.report()["controls"]:
            sandbox.scroll_to("plots.add", "plots.Copies")
        stage.keep(f"{theme}-{scale}-4")
        sandbox.close()


@case
def front(stage):
    """M and I bring their card to the front, and close it only where it stands there"""
    sandbox = start(stage, "hanging")
    sandbox.key("m")
    sandbox.wait(lambda r: r["tab"] == "Map", "the map")
    sandbox.key("i")
    sandbox.wait(lambda r: r["tab"] == "Step", "the step")
    sandbox.later(4)
    sandbox.key("m")
    sandbox.wait(lambda r: r["tab"] == "Map" and "plots.map" in r["controls"], "the map again, not closed")
    sandbox.later(4)
    sandbox.key("m")
    report = sandbox.wait(lambda r: "Map" not in r["tabs"] and r["map_cells"] is None, "the map to close")
    check("Step" in report["tabs"], "the step stays")


@case
def framed(stage):
    """the cloth is framed anew for each size of its picture, below the buttons, until the camera is taken in hand"""
    for preset, rows in (("hanging", (0,)), ("denim", (0,)), ("flag", None)):
        sandbox = start(stage, preset)
        sandbox.key("space")
        sandbox.key("r")  # the scene is framed for its start; a flag that flutters may leave the picture
        sandbox.wait(lambda r: r["paused"] and r["t"] == 0, "the cloth at its start")
        sandbox.later(4)
        check_in_picture(sandbox.report(), f"{preset} at first", rows)
        find(sandbox, "copies card")
        sandbox.click_control("plots.add")
        sandbox.click_control("menu.Equal_copy")
        sandbox.wait(lambda r: len(r["copies"]) == 1, "the copy")
        report = sandbox.later(6)
        check_in_picture(report, f"{preset} beside its copy", rows)
        stage.keep(f"{preset}-copy")
        sandbox.key("ctrl+t")
        sandbox.key("ctrl+t")
        sandbox.wait(lambda r: r["theme"] == "projector", "the projector")
        check_in_picture(sandbox.later(6), f"{preset} with a projector", rows)
        stage.keep(f"{preset}-projector")
        sandbox.close()
    for scale in (1.5, 2):
        sandbox = start(stage, "hanging", scale)
        sandbox.key("space")
        check_in_picture(sandbox.later(6), f"at {scale}", (0,))
        stage.keep(f"scale-{scale}")
        sandbox.close()
    sandbox = start(stage, "hanging")
    x, y, width, height = sandbox.report()["viewport"]
    sandbox.move(x + width / 2, y + height / 2)
    sandbox.acted("the wheel", "click", 4)
    by_hand = sandbox.later(4)["camera"]
    sandbox.key("ctrl+t")
    sandbox.key("ctrl+t")
    sandbox.wait(lambda r: r["theme"] == "projector", "the projector")
    check(sandbox.later(6)["camera"] == by_hand, "a view of one's own stays")
    sandbox.key("f")
    sandbox.wait(lambda r: r["camera"] != by_hand, "F to frame it")


@case
def in_turn(stage):
    """where the text leaves no room beside the cloth, constants, plots and cloth take turns in the whole window"""
    sandbox = start(stage, "hanging", 2.6, size=(900, 600))
    report = sandbox.wait(lambda r: "side.columns.3" in r["controls"], "the tabs")
    check(report["viewport"][2] == 900, "the cloth at first")
    stage.keep("cloth")
    sandbox.click_control("side.columns.1")
    report = sandbox.wait(lambda r: "constants.k_s.slider" in r["controls"] or "constants.dt.slider" in r["controls"],
                          "the constants")
    stage.keep("constants")
    find(sandbox, "forces card")
    sandbox.wait(lambda r: "plots.cards" in r["controls"], "the plots, by a command")
    stage.keep("plots")
    sandbox.click_control("side.columns.3")
    sandbox.wait(lambda r: r["viewport"][2] == 900, "the cloth again")


@case
def lab(stage):
    """where a lab's strip would leave the plots too low, they take its place, and it is seen with the constants"""
    for scale, size in ((2, (1280, 720)), (2.6, (1280, 720)), (2.6, (900, 600))):
        sandbox = start(stage, "hanging", scale, size=size)
        find(sandbox, "what kinks")
        sandbox.wait(lambda r: r["lab"] is not None and "lab.leave" in r["controls"], "the lab")
        find(sandbox, "accuracy card")
        report = sandbox.wait(lambda r: r["tab"] == "Accuracy" and "plots.cards" in r["controls"], "the card")
        check("lab.leave" not in report["controls"] and report["lab"] is not None, "it has the lab's place")
        stage.keep(f"plots-{scale}-{size[0]}")
        sandbox.click_control("side.columns.1")
        sandbox.wait(lambda r: "lab.leave" in r["controls"], "the lab, with the constants")
        stage.keep(f"constants-{scale}-{size[0]}")
        sandbox.close()


@case
def clean_lab(stage):
    """a lab begins without the copies that were there, and says so"""
    sandbox = start(stage, "hanging")
    find(sandbox, "copies card")
    sandbox.click_control("plots.add")
    sandbox.click_control("menu.Euler")
    sandbox.wait(lambda r: len(r["copies"]) == 1, "the copy")
    find(sandbox, "what kinks")
    report = sandbox.wait(lambda r: r["lab"] is not None and not r["copies"], "the lab, without it")
    check(any("removed" in m for m in report["messages"]), "it says so")
    check(report["pictures"] == [1, 1], "one picture")
    stage.keep("lab")


if __name__ == "__main__":
    main()
