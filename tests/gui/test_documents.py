"""Presets are saved, opened and remembered; what is not saved is never lost without a question."""

import json
import os
import signal
import subprocess

from cases import case, check, main
from sandbox import k_s


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
def save_and_load(stage):
    """a preset is saved to a file, read by the command line, and loaded again"""
    sandbox = stage.start("hanging")
    file = os.path.join(sandbox.config, "presets", "stiff.json")
    sandbox.type_value("k_s", "123")
    sandbox.key("ctrl+s")
    save_as(sandbox, "Stiff cloth", file)
    stage.keep("save-dialog")
    sandbox.click_control("dialog.Save")
    report = sandbox.wait(lambda r: r["dialog"] == "none" and not r["unsaved"], "the preset to be saved")
    check(report["file"] == file and report["preset"]["name"] == "Stiff cloth", "it has its file and name")
    with open(file) as saved:
        preset = json.load(saved)
    check(preset["forces"]["k_s"] == 123 and preset["name"] == "Stiff cloth", "the file holds what was saved")
    judged = subprocess.run([sandbox.tyglab, "presets", "check", file], capture_output=True, text=True)
    check(judged.returncode == 0, "tyglab presets check finds no fault: " + judged.stderr)

    sandbox.type_value("k_s", "77")
    sandbox.wait(lambda r: r["unsaved"], "the change to count as unsaved")
    sandbox.key("ctrl+o")
    sandbox.wait(lambda r: r["dialog"] == "open", "the open dialog")
    fill(sandbox, "path", file)
    stage.keep("open-dialog")
    sandbox.click_control("dialog.Open")
    sandbox.wait(lambda r: r["dialog"] == "unsaved", "the question about what is not saved")
    stage.keep("unsaved-question")
    check(k_s(sandbox.report()) == 77, "nothing is lost yet")
    sandbox.click_control("dialog.Discard_the_changes")
    report = sandbox.wait(lambda r: k_s(r) == 123, "the file to be loaded")
    check(report["preset"]["name"] == "Stiff cloth" and not report["unsaved"], "as it was saved")
    check(report["dialog"] == "none", "no dialog is left")


@case
def save_as_again(stage):
    """the file follows a new name every time; a file that exists is replaced only after a question"""
    sandbox = stage.start("hanging")
    for name in ("First", "Second"):
        sandbox.key("ctrl+shift+s")
        sandbox.wait(lambda r: r["dialog"] == "save", "the save dialog")
        fill(sandbox, "name", name)
        sandbox.click_control("dialog.Save")
        report = sandbox.wait(lambda r: r["dialog"] == "none", "the preset to be saved")
        check(os.path.basename(report["file"]) == name.lower() + ".json", f"{name} has a file of its own")
    sandbox.key("ctrl+shift+s")
    sandbox.wait(lambda r: r["dialog"] == "save", "the save dialog")
    sandbox.click_control("dialog.Save")
    sandbox.wait(lambda r: "dialog.Replace" in r["controls"], "the question")
    sandbox.key("Escape")
    sandbox.wait(lambda r: r["dialog"] == "none", "Escape to close the dialog")


@case
def shipped(stage):
    """a shipped preset is opened from the list; saving over it is refused"""
    sandbox = stage.start("hanging")
    sandbox.key("ctrl+o")
    sandbox.wait(lambda r: r["dialog"] == "open", "the open dialog")
    sandbox.click_control("dialog.entry.denim")
    sandbox.click_control("dialog.Open")
    report = sandbox.wait(lambda r: r["label"] == "denim" and r["dialog"] == "none", "denim to be opened")
    check(report["file"] == "" and not report["unsaved"], "it is the shipped preset")
    sandbox.key("ctrl+shift+s")
    folder = os.path.join(os.path.dirname(os.path.dirname(sandbox.tyglab)), "share", "tyglab", "presets")
    before = os.stat(os.path.join(folder, "denim.json")).st_mtime_ns
    save_as(sandbox, "Denim", os.path.join(folder, "denim.json"))
    sandbox.click_control("dialog.Save")
    sandbox.later(4)
    if "dialog.Replace" in sandbox.report()["controls"]:
        sandbox.click_control("dialog.Replace")
    sandbox.wait(lambda r: "program itself" in r["problem"], "the refusal")
    stage.keep("refused")
    check(os.stat(os.path.join(folder, "denim.json")).st_mtime_ns == before, "the shipped file is untouched")
    sandbox.key("Escape")
    sandbox.wait(lambda r: r["dialog"] == "none", "Escape to close the dialog")


@case
def by_name(stage):
    """a shipped preset's name typed into the dialog opens it, as on the command line; its constants begin at the top"""
    sandbox = stage.start("hanging")
    top = sandbox.control("constants.integrator")
    sandbox.scroll_to("constants.texture", "constants.k_s.slider")
    check("constants.integrator" not in sandbox.later()["controls"], "the constants are scrolled down")
    sandbox.key("ctrl+o")
    sandbox.wait(lambda r: r["dialog"] == "open", "the open dialog")
    fill(sandbox, "path", "denin")
    sandbox.key("Return")
    sandbox.wait(lambda r: "Did you mean 'denim'?" in r["problem"], "the nearest name to be offered")
    sandbox.wait(lambda r: r["typing"], "the field to take keys again")
    sandbox.type("denim")  # over the wrong name, which is selected
    sandbox.later(4)
    sandbox.key("Return")
    report = sandbox.wait(lambda r: r["label"] == "denim" and r["dialog"] == "none", "denim to be opened")
    check(report["file"] == "" and not report["unsaved"], "it is the shipped preset")
    check(sandbox.control("constants.integrator") == top, "its constants are shown from the first one on")


@case
def wrong_file(stage):
    """a wrong file is refused with the reason, where another can be chosen, and nothing changes"""
    sandbox = stage.start("hanging")
    wrong = os.path.join(sandbox.own.name, "wrong.json")
    with open(wrong, "w") as file:
        file.write('{"tyglab_preset": 1,\n "forces": {"k_z": 3}}\n')
    sandbox.key("ctrl+o")
    sandbox.wait(lambda r: r["dialog"] == "open", "the open dialog")
    fill(sandbox, "path", wrong)
    sandbox.click_control("dialog.Open")
    report = sandbox.wait(lambda r: "k_z" in r["problem"], "the reason to be said")
    check("wrong.json" in report["problem"] and "k_s" in report["problem"], "it names file and nearest key: " + report["problem"])
    stage.keep("reason")
    check(report["label"] == "hanging" and not report["unsaved"], "the old preset stays")
    sandbox.click_control("dialog.Cancel")
    sandbox.wait(lambda r: r["dialog"] == "none", "Cancel to close the dialog")


@case
def unwritable(stage):
    """a preset that cannot be written stays unsaved, and the dialog says why"""
    sandbox = stage.start("hanging")
    sandbox.type_value("k_s", "60")
    sandbox.key("ctrl+s")
    save_as(sandbox, "Nowhere", "/proc/nowhere/preset.json")
    sandbox.click_control("dialog.Save")
    report = sandbox.wait(lambda r: r["problem"] != "", "the reason to be said")
    check(report["unsaved"] and report["dialog"] == "save", "it is still unsaved, and the dialog open")
    stage.keep("reason")


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
    """the last session comes back with its window: what was discarded does not, what Ctrl-C caught unsaved does"""
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
    check(again.ended() == 130, "it ends")
    third = stage.start(config=sandbox.config)
    report = third.report()
    check(k_s(report) == 45 and report["unsaved"], "what was not saved is back, and counts as unsaved")


@case
def broken_settings(stage):
    """settings of no use are kept beside, and said in plain words; a folder that cannot be written is said at once"""
    sandbox = stage.start("hanging")
    sandbox.key("ctrl+q")
    sandbox.ended()
    with open(sandbox.settings_file, "w") as file:
        file.write("[]")
    again = stage.start("hanging", config=sandbox.config)
    report = again.wait(lambda r: r["messages"], "a message")
    check("settings.json.broken" in report["messages"][0] and "exception" not in report["messages"][0],
          f"it says where the file is: {report['messages']}")
    with open(again.settings_file + ".broken") as file:
        check(file.read() == "[]", "the file is kept")
    again.close()
    # A file where the folder should be stops even an administrator.
    blocked = os.path.join(sandbox.own.name, "file", "config")
    with open(os.path.dirname(blocked), "w") as file:
        file.write("in the way")
    third = stage.start("hanging", config=blocked, with_settings=False)
    report = third.wait(lambda r: r["messages"], "a message")
    check("will not be remembered" in report["messages"][0], f"it says so: {report['messages']}")


if __name__ == "__main__":
    main()
