"""Presets are saved, opened and remembered; what is not saved is never lost without a question."""

import json
import os
import signal
import time

from cases import case, check, main
from sandbox import PATIENCE, k_s


def fill(sandbox, field, text):
    """Replaces the text of a dialog's field."""
    sandbox.click_control("dialog." + field)
    sandbox.key("ctrl+a")
    sandbox.later(2)
    sandbox.type(text)
    sandbox.later(4)


def save_as(sandbox, name, file):
    sandbox.wait(lambda r: r["dialog"] == "save", "the save dialog")
    fill(sandbox, "name", name)
    fill(sandbox, "path", file)


@case
def close_unsaved(stage):
    """closing asks while changes are unsaved; Escape stays, Save saves first"""
    sandbox = stage.start("hanging")
    sandbox.type_value("k_s", "66")
    for ask in (sandbox.press_close_button, lambda: sandbox.key("ctrl+q")):
        ask()
        sandbox.wait(lambda r: r["dialog"] == "unsaved", "the question")
        sandbox.later(3)
        sandbox.key("Escape")
        sandbox.wait(lambda r: r["dialog"] == "none", "Escape to stay")
        check(sandbox.process.poll() is None, "the program lives")
    sandbox.key("Escape")
    check(sandbox.later()["dialog"] == "none", "Escape alone does not quit")
    sandbox.press_close_button()
    file = os.path.join(sandbox.config, "presets", "kept.json")
    sandbox.click_control("dialog.Save")
    save_as(sandbox, "Kept", file)
    check(sandbox.click_the_end("dialog.Save") == 0, "it ends once the preset is saved")
    with open(file) as saved:
        check(json.load(saved)["forces"]["k_s"] == 66, "what was saved is on disk")


@case
def session(stage):
    """the last session comes back with its window; what was discarded does not, what Ctrl-C caught unsaved does"""
    sandbox = stage.start("curtain", size=(1100, 700))
    k_s_saved = k_s(sandbox.report())
    sandbox.type_value("k_s", "44")
    sandbox.press_close_button()
    check(sandbox.click_the_end("dialog.Discard_the_changes") == 0, "it ends")
    again = stage.start(config=sandbox.config)
    report = again.report()
    check(report["label"] == "curtain", "curtain is back, not " + report["label"])
    check(report["window"] == [1100, 700], f"the window is as large as it was: {report['window']}")
    check(k_s(report) == k_s_saved and not report["unsaved"], "what was discarded is gone")
    again.type_value("k_s", "45")
    again.process.send_signal(signal.SIGINT)
    check(again.ended() == 130, f"Ctrl-C in the terminal ends it: the exit code is {again.process.returncode}")
    check(again.report()["ended"], "the last report says that it ended")
    third = stage.start(config=sandbox.config)
    report = third.report()
    check(k_s(report) == 45 and report["unsaved"], "what was not saved is back, and counts as unsaved")
    third.process.send_signal(signal.SIGTERM)
    check(third.ended() == 130, f"so does SIGTERM: the exit code is {third.process.returncode}")
    with open(third.settings_file, "w") as file:
        file.write("[]")
    fourth = stage.start("hanging", config=sandbox.config)
    report = fourth.wait(lambda r: r["messages"], "a message on settings that cannot be read")
    check("settings.json.broken" in report["messages"][0], f"it says where the file is: {report['messages']}")


def until(condition, what):
    """Waits for what no report tells."""
    end = time.monotonic() + PATIENCE
    while not condition():
        check(time.monotonic() < end, "in time: " + what)
        time.sleep(0.05)


@case
def killed(stage):
    """kill -9 loses nothing: what was changed comes back, unsaved as it was"""
    sandbox = stage.start("curtain")
    sandbox.type_value("k_s", "71")

    def written():
        with open(sandbox.settings_file) as file:
            session = json.load(file).get("session")
        return session is not None and session["preset"]["forces"]["k_s"] == 71

    until(written, "the change is on disk while the window is open")
    sandbox.process.kill()
    sandbox.process.wait()
    again = stage.start(config=sandbox.config)
    report = again.report()
    check(report["label"] == "curtain" and k_s(report) == 71 and report["unsaved"], "it is back, and counts as unsaved")


if __name__ == "__main__":
    main()
