#!/usr/bin/python3
"""test_window.py --tyglab PROGRAM: the window of Tyglab for Windows on the present display, under Wine, with
real mouse and key events (xdotool): a lab played to its end, and what is kept in %APPDATA%."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

SECONDS = 300  # until something is there: Wine and a processor that draws are slow, and other work may slow them further


def until(what, good):
    """The first true value of good()."""
    end = time.monotonic() + SECONDS
    while not (found := good()):
        if time.monotonic() > end:
            raise RuntimeError(f"not within {SECONDS} s: {what}")
        time.sleep(0.2)
    return found


def said_by(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=SECONDS).stdout.strip()


class Window:
    """A lab in the program's window."""

    def __init__(self, tyglab, lab, folder):
        self.file = pathlib.Path(folder) / "report.json"
        self.process = subprocess.Popen([tyglab, "--lab", lab, "--session-report", self.file.name], cwd=folder,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until("the window", lambda: self.report() and self.report()["frames"] > 5)
        self.number = until("the window's number", self.find)
        self.xdotool("windowfocus", "--sync", self.number)

    def find(self):
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Tyglab"], capture_output=True, text=True)
        return found.stdout.split()[0] if found.stdout else None

    def xdotool(self, *words):
        said_by("xdotool", *map(str, words))

    def report(self):
        try:
            return json.loads(self.file.read_text(encoding="utf-8"))
        except (OSError, ValueError):  # not there yet, or being replaced
            return None

    def wait(self, what, good):
        return until(what, lambda: (now := self.report()) is not None and good(now) and now)

    def key(self, name):
        before = self.report()["events"]
        self.xdotool("key", name)
        self.wait(f"{name} arrives", lambda now: now["events"] > before)

    def press(self, name):
        """Clicks a control, once it is there and has stopped moving."""
        last = None
        while True:
            now = self.wait(f"the control {name}", lambda now: name in now["controls"])["controls"][name]
            if now == last:
                break
            last = now
            time.sleep(0.3)
        x, y, width, height = last
        self.xdotool("mousemove", "--window", self.number, int(x + width / 2), int(y + height / 2))
        time.sleep(0.3)
        self.xdotool("mousedown", 1)
        time.sleep(0.2)
        self.xdotool("mouseup", 1)


def play_lab(window):
    def done():
        return window.wait("the step is done", lambda now: now["lab"]["done"])["lab"]

    window.press("top.play")
    for choice in ["lab.choice.1", "lab.choice.2"]:
        step = done()["step"]
        window.press("lab.Next")
        window.wait("the next step", lambda now: now["lab"]["step"] == step + 1)
        window.press(choice)
        window.press("lab.Predict")
        window.wait("the prediction", lambda now: now["lab"]["predicted"])
        window.press("top.play")
        assert done()["right"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tyglab", required=True)
    args = parser.parse_args()
    roaming = pathlib.Path(said_by("winepath", "-u", said_by("wine", "cmd", "/c", "echo %APPDATA%")))
    settings = roaming / "tyglab" / "settings.json"
    assert roaming.is_dir() and not settings.exists(), f"{roaming} is not that of a new user"
    with tempfile.TemporaryDirectory() as folder:
        window = Window(args.tyglab, "06_float", folder)
        play_lab(window)
        window.press("lab.Finish")
        window.wait("the lab ends", lambda now: now["lab"] is None)
        theme = window.report()["theme"]
        window.key("ctrl+t")
        theme = window.wait("another theme", lambda now: now["theme"] != theme)["theme"]
        until("the settings are kept", lambda: settings.exists() and theme in settings.read_text(encoding="utf-8"))
        until("the lab's progress is kept", lambda: any("06_float" in file.name + file.read_text(encoding="utf-8")
                                                        for file in settings.parent.rglob("*.json")))
        window.key("ctrl+q")
        assert window.process.wait(SECONDS) == 0, f"exit code {window.process.returncode}"
        print(f"The window is sound; its settings are in {settings.parent.relative_to(roaming.parent)}.")


if __name__ == "__main__":
    sys.exit(main())
