"""A lab in a real window, played from end to end."""

import json

from cases import case, check, main
from sandbox import RIGHT


def lab(sandbox, condition, what):
    return sandbox.wait(lambda r: r["lab"] is not None and condition(r["lab"]), what)


def begin(sandbox, typed, label):
    """Chooses a lab by the cap in the top bar and some letters of its title."""
    sandbox.click_control("top.labs")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the list of labs")
    sandbox.later(3)
    sandbox.type(typed)
    sandbox.later(4)
    sandbox.key("Return")
    lab(sandbox, lambda l: l["label"] == label, "the lab to begin")
    return sandbox.wait(lambda r: r["paused"] and not r["palette"], "its first step")


def predict(sandbox, text):
    """Types a prediction."""
    sandbox.click_control("lab.prediction")
    sandbox.wait(lambda r: r["typing"], "the field to take keys")
    sandbox.type(text)
    sandbox.later(3)
    sandbox.key("Return")
    lab(sandbox, lambda l: l["predicted"], "the prediction to be taken")
    sandbox.wait(lambda r: not r["typing"], "the field to close")
    sandbox.later(2)


def choose(sandbox, number):
    sandbox.click_control(f"lab.choice.{number}")
    sandbox.click_control("lab.Predict")
    lab(sandbox, lambda l: l["predicted"], "the choice to be taken")


def go_on(sandbox, step):
    sandbox.click_control("lab.Next")
    lab(sandbox, lambda l: l["step"] == step and not l["done"], f"step {step + 1}")
    return sandbox.later(4)


@case
def hooke(stage):
    """the lab on Hooke's law is played from its beginning to its end, and what is done is remembered"""
    sandbox = stage.start("denim")
    begin(sandbox, "hooke", "01_hooke")
    sandbox.wait(lambda r: r["label"] == "one_weight" and r["t"] == 0, "its preset to open")
    stage.keep("1-read")
    sandbox.key("space")
    report = sandbox.wait(lambda r: r["t"] > 3, "the weight to come to rest")
    check(not report["lab"]["done"], "nothing is checked before a prediction")
    predict(sandbox, "0,09")
    report = lab(sandbox, lambda l: l["done"], "the weight at rest to count")
    check(not report["lab"]["right"], "0.09 m is not right")
    stage.keep("2-wrong")
    go_on(sandbox, 1)
    predict(sandbox, "0.049 m")
    report = sandbox.later(10)
    check(not report["lab"]["done"], "k has not been changed")
    sandbox.type_value("k", "20")
    report = lab(sandbox, lambda l: l["done"], "the stiffer spring's rest to count")
    check(report["lab"]["right"], "0.049 m is right")
    stage.keep("3-right")
    report = go_on(sandbox, 2)
    check(report["label"] == "hanging" and report["preset"]["cloth"]["rows"] == 12 and not report["unsaved"],
          "the cloth of the third step, as it stands in the lab")
    choose(sandbox, 2)
    sandbox.key("space")
    at = report["particles"][12]["at"]
    sandbox.click(*at, button=RIGHT)
    lab(sandbox, lambda l: l["done"] and l["right"], "the cloth to come to rest")
    stage.keep("4-cloth")
    sandbox.click_control("lab.Finish")
    sandbox.wait(lambda r: r["lab"] is None, "the lab to close")
    sandbox.key("ctrl+l")
    sandbox.wait(lambda r: r["palette"], "the labs by keyboard")
    sandbox.later(4)
    stage.keep("5-list")
    sandbox.key("Escape")
    sandbox.wait(lambda r: not r["palette"], "the list to close")
    sandbox.press_close_button()
    check(sandbox.ended() == 0, "it ends")
    with open(sandbox.settings_file) as file:
        check(json.load(file)["labs"] == {"01_hooke": 3}, "what is done is remembered")


if __name__ == "__main__":
    main()
