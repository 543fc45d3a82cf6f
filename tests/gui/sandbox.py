"""Drives Tyglab's window with a real mouse and keyboard (xdotool), and waits for what its session report says."""

import json
import os
import signal
import subprocess
import tempfile
import time

from screen import end_with_parent
from xclient import XClient

# s until a condition counts as never met; far above what a loaded machine takes.
PATIENCE = float(os.environ.get("TYGLAB_GUI_PATIENCE", 120))
LEFT, MIDDLE, RIGHT = 1, 2, 3


def centre(box):
    return box[0] + box[2] / 2, box[1] + box[3] / 2


class Sandbox:
    """The program in a window of `size`, with a folder of its own for settings and presets."""

    def __init__(self, tyglab, screen, arguments, size=(1280, 720), config=None, with_settings=True, reported=True,
                 tour_seen=True, effects="few", settings=None, environment=None):
        """`effects`: few take half the time of all where a processor draws; they say nothing of what is tested.
        `settings`: more of the settings' file; `environment`: more variables."""
        self.screen = screen
        self.tyglab = tyglab
        self.own = tempfile.TemporaryDirectory(prefix="tyglab-gui-", ignore_cleanup_errors=True)
        self.config = config or os.path.join(self.own.name, "config")
        self.report_file = os.path.join(self.own.name, "report.json")
        self.errors = open(os.path.join(self.own.name, "stderr"), "w+")
        self.settings_file = os.path.join(self.config, "settings.json")
        if with_settings and not os.path.exists(self.settings_file):
            os.makedirs(self.config, exist_ok=True)
            with open(self.settings_file, "w") as file:
                json.dump({"window": {"x": 0, "y": 0, "width": size[0], "height": size[1]}, "tour_seen": tour_seen,
                           **(settings or {})}, file)
        self.environment = dict(os.environ, DISPLAY=screen.display, TYGLAB_CONFIG_DIR=self.config, **(environment or {}))
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.client = XClient(screen.display)
        self.client.move_mouse(screen.width - 1, screen.height - 1)
        report = ["--session-report", self.report_file] if reported else []
        self.process = subprocess.Popen([tyglab, "--effects", effects, *arguments, *report], stderr=self.errors,
                                        env=self.environment, cwd=self.own.name, preexec_fn=end_with_parent)
        if reported:
            self.wait(lambda r: r["frames"] >= 3, "the window's first frames")
        own = ("--all", "--pid", self.process.pid, "--name", "Tyglab")
        self.window = int(self.xdotool("search", "--sync", "--onlyvisible", *own).split()[0])
        self.xdotool("windowfocus", self.window)

    def xdotool(self, *arguments):
        done = subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, capture_output=True, text=True,
                              timeout=PATIENCE)
        if done.returncode != 0:
            raise AssertionError(f"xdotool {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return done.stdout

    # What it does.

    def report(self):
        """The latest report, or None before the first."""
        try:
            with open(self.report_file) as file:
                return json.load(file)
        except FileNotFoundError:
            return None

    def wait(self, condition, what):
        """The first report for which the condition holds."""
        end = time.monotonic() + PATIENCE
        while True:
            report = self.report()
            if report is not None and condition(report):
                return report
            if self.process.poll() is not None:
                raise AssertionError(f"the program ended (exit code {self.process.returncode}) before: {what}\n{self.stderr()}")
            if time.monotonic() > end:
                raise AssertionError(f"waited {PATIENCE} s in vain for: {what}\n{digest(report)}")
            time.sleep(0.02)

    def later(self, frames=3):
        """A report at least so many frames after what stands in the present one."""
        begun = self.report()["frames"]
        return self.wait(lambda r: r["frames"] >= begun + frames, f"{frames} more frames")

    def still_picture(self, part=None):
        """What the screen shows once it, or a part of it, has stopped changing: some frames and a while apart it is the
        same."""
        def seen():
            picture = self.screen.picture()
            return picture, picture.crop(part) if part else picture

        end = time.monotonic() + PATIENCE
        last = seen()
        while time.monotonic() < end:
            time.sleep(0.3)
            self.later(3)
            now = seen()
            if now[1] == last[1]:
                return now[0]
            last = now
        raise AssertionError(f"the picture goes on changing\n{digest(self.report())}")

    def control(self, name):
        """Place of a control, once it stands still: a dialog follows its text some frames later."""
        last = None
        while True:
            report = self.wait(lambda r: name in r["controls"] and (last is None or r["frames"] > last["frames"] + 2),
                               f"the control {name} to be seen")
            if last is not None and last["controls"][name] == report["controls"][name]:
                return report["controls"][name]
            last = report

    # Mouse and keyboard.

    def acted(self, what, *arguments):
        """Runs xdotool and waits until the program has seen the press, release or key."""
        before = self.report()["events"]
        self.xdotool(*arguments)
        return self.wait(lambda r: r["events"] > before, what)

    def move(self, x, y):
        x, y = round(x), round(y)
        self.client.move_mouse(x, y)
        at = self.client.mouse()
        again = time.monotonic() + 10

        def arrived(report):
            nonlocal again
            if time.monotonic() > again:
                # A hand goes on moving. On a loaded machine GLFW was not told of a motion three times in some hundred
                # runs, though the X server had the mouse there, by XWarpPointer and by XTEST.
                self.client.move_mouse(x + 1, y)
                self.client.move_mouse(x, y)
                again = time.monotonic() + 10
            return [round(v) for v in report["pointer"]] == [x, y]

        self.wait(arrived, f"the pointer to come to ({x}, {y}); the X server has it at {at}")

    def press(self, button=LEFT):
        self.acted(f"the press of button {button}", "mousedown", button)
        self.later(2)

    def release(self, button=LEFT):
        self.acted(f"the release of button {button}", "mouseup", button)

    def click(self, x, y, button=LEFT):
        self.move(x, y)
        self.press(button)
        self.release(button)
        self.later(2)

    def click_the_end(self, name):
        """Clicks a control after which the program ends; returns its exit code."""
        self.move(*centre(self.control(name)))
        self.press()
        self.xdotool("mouseup", LEFT)
        return self.ended()

    def double_click(self, x, y, button, done, what):
        """Double-clicks until the condition holds: a busy machine may come between the clicks, or merge them."""
        self.move(x, y)
        for _ in range(6):
            before = self.report()["events"]
            self.xdotool("click", "--repeat", 2, "--delay", 110, button)
            self.wait(lambda r: r["events"] >= before + 4, "the double click to arrive")
            report = self.later(3)
            if done(report):
                return report
            time.sleep(0.5)  # or the next press would belong to this double click
        raise AssertionError(f"six double clicks did not lead to: {what}\n{digest(report)}")

    def click_control(self, name):
        self.click(*centre(self.control(name)))

    def drag(self, points, button=LEFT):
        """Presses at the first point, moves over the others, lets go at the last."""
        self.move(*points[0])
        self.press(button)
        for point in points[1:]:
            self.move(*point)
        self.later(2)
        self.release(button)

    def in_one_frame(self, *arguments):
        """Runs xdotool while the program stands still, so that all of it falls into one of its frames."""
        before = self.report()["events"]
        self.process.send_signal(signal.SIGSTOP)
        self.xdotool(*arguments)
        self.process.send_signal(signal.SIGCONT)
        self.wait(lambda r: r["events"] > before, "the events to arrive")
        return self.later(3)

    def find(self, text):
        """Does what the palette finds first."""
        self.key("ctrl+p")
        self.wait(lambda r: r["palette"] and r["typing"], "the palette to take keys")
        self.type(text)
        self.later(3)
        self.key("Return")
        self.wait(lambda r: not r["palette"], "the palette to close")

    def key(self, *keys):
        return self.acted("the key " + " ".join(keys), "key", *keys)

    def type(self, text):
        self.xdotool("type", "--delay", 15, "--", text)

    def type_value(self, key, text, end="Return"):
        """Types the value of a constant: Ctrl+click on its number, the text, and the key that ends it."""
        self.move(*centre(self.control(f"constants.{key}.value")))
        self.acted("Ctrl going down", "keydown", "ctrl")
        self.press()
        self.release()
        self.xdotool("keyup", "ctrl")
        self.wait(lambda r: r["typing"], "the number to become a text field")
        self.later(2)
        self.type(text)
        self.later(3)
        self.key(end)
        self.wait(lambda r: not r["typing"], "the text field to close")
        return self.later(2)

    def rest(self):
        """Takes the pointer where it touches nothing."""
        x, y, width, height = self.report()["viewport"]
        self.move(x + width / 2, y + height + 15)
        self.later(2)

    # Its end.

    def press_close_button(self):
        self.client.close_window(self.window)

    def ended(self):
        """Waits for the end; returns the exit code."""
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"the program did not end within {PATIENCE} s") from None

    def stderr(self):
        self.errors.flush()
        with open(self.errors.name) as file:
            return file.read()

    def close(self):
        self.client.close()
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.errors.close()
        self.own.cleanup()


def digest(report):
    """A report without its long lists, for messages."""
    if report is None:
        return "there was no report"
    short = {key: value for key, value in report.items() if key not in ("particles", "controls", "preset")}
    return "last report: " + json.dumps(short)


def k_s(report):
    return report["preset"]["forces"]["k_s"]
