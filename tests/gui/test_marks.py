"""What stands over the cloth: no mark over another, at every size of window and text, in every theme."""

from cases import case, check, main
from sandbox import RIGHT, centre

# Window, scale of text, theme.
LOOKS = [((1280, 720), 1, "dark"), ((1280, 720), 1, "projector"), ((1280, 720), 2, "light"), ((900, 600), 1, "light"),
         ((900, 600), 2, "dark"), ((1920, 1080), 1.5, "projector"), ((1920, 1080), 2, "dark")]


def start(stage, look, *arguments, labs=None):
    size, scale, theme = look
    return stage.start(*arguments, size=size,
                       settings={"ui_scale": scale, "theme": theme, "labs": labs or {}})


def pause(sandbox):
    sandbox.wait(lambda r: r["t"] > 0.3, "the cloth to fall a little")
    sandbox.key("space")
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.rest()
    return sandbox.later(6)


def overlap(a, b):
    return a[0] < b[0] + b[2] and b[0] < a[0] + a[2] and a[1] < b[1] + b[3] and b[1] < a[1] + a[3]


def judge(report, look, wanted=()):
    """No two marks overlap, all are within the window, and those that are wanted are there."""
    marks = report["marks"]
    names = sorted(marks)
    for k, name in enumerate(names):
        x, y, width, height = marks[name]
        check(x >= 0 and y >= 0 and x + width <= look[0][0] and y + height <= look[0][1], f"{look}: {name} is cut off")
        for other in names[k + 1:]:
            check(not overlap(marks[name], marks[other]), f"{look}: {name} {marks[name]} covers {other} {marks[other]}")
    for name in wanted:
        check(name in marks, f"{look}: {name} is not there, only {names}")


def shot(stage, what, look):
    stage.keep(f"{what}-{look[0][0]}-{look[1]}-{look[2]}")


@case
def one_picture(stage):
    """legend, scale of arrows, labels and PAUSED keep apart, and PAUSED off the cloth"""
    for look in LOOKS:
        sandbox = start(stage, look, "hanging", "--color", "tension")
        report = pause(sandbox)
        shot(stage, "tension", look)
        judge(report, look, ("views", "legend", "paused", "scale N"))
        sandbox.close()


@case
def views(stage):
    """the check of view 2 has a ground of its own beside or under the buttons, and the wind's label is seen"""
    for look in LOOKS[:4]:
        sandbox = start(stage, look, "flag", "--color", "tension", "--set", "mode=2")
        report = pause(sandbox)
        shot(stage, "flag", look)
        judge(report, look, ("views", "bending", "legend", "wind"))
        sandbox.close()


@case
def copies(stage):
    """the names of copies, the legend and the scales keep apart beside, above and under each other"""
    for look in LOOKS[1:5]:
        sandbox = start(stage, look, "hanging", "--color", "tension")
        for count, item in enumerate(("copy_double", "copy_half"), 1):
            sandbox.click(*centre(sandbox.control("constants.k_s.value")), RIGHT)
            sandbox.click_control("menu." + item)
            sandbox.wait(lambda r: len(r["copies"]) == count, "the copy")
            report = pause(sandbox) if count == 1 else sandbox.later(6)
            sandbox.rest()
            report = sandbox.later(3)
            shot(stage, f"copies{count}", look)
            judge(report, look, ("views", "name 0", "name 1", "paused"))
        across, down = report["pictures"]
        x, y, width, height = report["viewport"]
        wide_enough = look[:2] != ((900, 600), 2)  # there no cell holds a legend
        if "legend" in report["marks"] and across == 2 and down == 2 and wide_enough:
            at = report["marks"]["legend"]
            check(at[0] > x + width / 2 and at[1] > y + height / 2, f"{look}: the legend takes the cell that is empty")
            row = report["marks"]["views"]
            at = report["marks"]["paused"]
            empty = at[0] > x + width / 2 and at[1] > y + height / 2
            check(at[1] < row[1] + row[3] or empty, f"{look}: PAUSED stands on no picture")
        sandbox.close()


@case
def weight(stage):
    """PAUSED stands clear of the one weight's spring"""
    for look in LOOKS[:5]:
        sandbox = start(stage, look, "one_weight")
        if not sandbox.report()["paused"]:
            sandbox.key("space")
        sandbox.wait(lambda r: r["paused"], "the pause")
        sandbox.rest()
        report = sandbox.later(6)
        shot(stage, "weight", look)
        judge(report, look, ("paused",))
        x = report["particles"][0]["at"][0]
        left, _, width, _ = report["marks"]["paused"]
        check(x < left or x > left + width, f"{look}: PAUSED over the spring")
        sandbox.close()


@case
def messages(stage):
    """a message and PAUSED stand apart"""
    for look in LOOKS[:5]:
        sandbox = start(stage, look, "hanging")
        sandbox.key("space")
        sandbox.wait(lambda r: r["paused"], "the pause")
        sandbox.type_value("k_s", "abc")
        sandbox.wait(lambda r: r["messages"], "the message")
        at = sandbox.control("viewport.dismiss")
        report = sandbox.report()
        shot(stage, "message", look)
        check(not overlap(at, report["marks"]["paused"]), f"{look}: the message covers PAUSED")
        sandbox.close()


@case
def lab(stage):
    """all choices of a lab's question are seen, and nothing over the low picture covers anything"""
    for look in LOOKS[:2] + LOOKS[5:]:
        sandbox = start(stage, look, "hanging", labs={"01_hooke": 2})
        sandbox.key("ctrl+l")
        sandbox.wait(lambda r: r["palette"] and r["typing"], "the list of labs")
        sandbox.later(3)
        sandbox.type("hooke")
        sandbox.later(4)
        sandbox.key("Return")
        sandbox.wait(lambda r: r["lab"] and r["lab"]["step"] == 2, "the third step")
        sandbox.wait(lambda r: r["label"] == "hanging" and r["t"] == 0, "its cloth")
        sandbox.rest()
        report = sandbox.later(8)
        shot(stage, "lab", look)
        judge(report, look, ("paused",))
        if look[1:] == (1, "dark"):
            for k in (1, 2, 3):
                check(report["controls"].get(f"lab.choice.{k}", [0, 0, 0, 0])[3] > 20, f"choice {k} is seen whole")
            check("lab.Predict" in report["controls"], "and the button")
        sandbox.close()


if __name__ == "__main__":
    main()
