#!/usr/bin/python3
"""test_firefox.py --page FOLDER [--shots FOLDER]: the page in Firefox on the present display, steered by WebDriver BiDi,
which Firefox speaks by itself: it opens, runs, and a step of a lab is done by real clicks and keys."""
import argparse
import base64
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import websocket  # python3-websocket

from test_page import press, served, wait_for

PREFERENCES = {
    "webgl.force-enabled": True,  # also where the processor draws
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "browser.aboutwelcome.enabled": False,
    "app.update.enabled": False,
}


class Firefox:
    """One page, at 1280 x 720; ends with its `with` block."""

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tyglab-firefox-"))
        (self.folder / "user.js").write_text("".join(f"user_pref({json.dumps(key)}, {json.dumps(value)});\n"
                                                     for key, value in PREFERENCES.items()))
        self.process = subprocess.Popen(["firefox-esr", "--no-remote", "--profile", self.folder, "--remote-debugging-port=0"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        address = next((line.partition("ws://")[2].strip() for line in self.process.stderr if "ws://" in line), None)
        if address is None:
            raise RuntimeError("Firefox did not start")
        threading.Thread(target=self.process.stderr.read, daemon=True).start()  # or it would wait for a reader
        self.socket = websocket.create_connection(f"ws://{address}/session", timeout=120, suppress_origin=True)
        self.number, self.errors = 0, []
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded"])
        self.context = self.call("browsingContext.create", type="tab")["context"]
        self.call("browsingContext.setViewport", context=self.context, viewport={"width": 1280, "height": 720})
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(60)
        shutil.rmtree(self.folder, ignore_errors=True)

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                if message["type"] == "error":
                    raise RuntimeError(f"{method}: {message['message']}")
                return message["result"]
            if message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                self.errors.append(message["params"]["text"])

    def open(self, address):
        self.call("browsingContext.navigate", context=self.context, url=address, wait="complete")
        end = time.monotonic() + 120
        while not self.ask("performance.getEntriesByName('tyglab first frame').length > 0"):
            if time.monotonic() > end:
                raise RuntimeError("no first frame within two minutes; the page says: " + self.ask("document.getElementById('words').textContent"))
            time.sleep(0.2)

    def ask(self, expression):
        """A JavaScript expression's value, waited for."""
        answer = self.call("script.evaluate", expression=f"(async () => JSON.stringify(await ({expression}) ?? null))()",
                           target={"context": self.context}, awaitPromise=True)
        if answer["type"] != "success":
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']['text']}")
        return json.loads(answer["result"]["value"])

    def click(self, x, y):
        actions = [{"type": "pointerMove", "x": round(x), "y": round(y)}, {"type": "pointerDown", "button": 0},
                   {"type": "pause", "duration": 100}, {"type": "pointerUp", "button": 0}]
        self.call("input.performActions", context=self.context, actions=[{"type": "pointer", "id": "mouse", "actions": actions}])
        time.sleep(0.4)

    def key(self, value, *_):
        actions = [{"type": "keyDown", "value": value}, {"type": "keyUp", "value": value}]
        self.call("input.performActions", context=self.context, actions=[{"type": "key", "id": "keys", "actions": actions}])

    def picture(self, file):
        shot = self.call("browsingContext.captureScreenshot", context=self.context)
        pathlib.Path(file).write_bytes(base64.b64decode(shot["data"]))


ESCAPE = "\ue00c"


def opens_and_runs(firefox, home):
    firefox.open(f"{home}/?report")
    wait_for(firefox, "the start page", lambda now: now["dialog"] == "start")
    firefox.key(ESCAPE)
    before = wait_for(firefox, "the start page closes", lambda now: now["dialog"] == "none")["steps"]
    wait_for(firefox, "the cloth moves", lambda now: now["steps"] > before + 100)


def lab_step(firefox, home):
    firefox.open(f"{home}/?report&lab=06_float")
    press(firefox, "top.play")
    wait_for(firefox, "the step is done", lambda now: now["lab"]["done"], 120)
    press(firefox, "lab.Next")
    wait_for(firefox, "the next step", lambda now: now["lab"]["step"] == 1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--page", required=True, type=pathlib.Path)
    parser.add_argument("--shots", type=pathlib.Path)
    args = parser.parse_args()
    with served(args.page) as home, Firefox() as firefox:
        for test in [opens_and_runs, lab_step]:
            test(firefox, home)
            print(f"  {test.__name__} in Firefox", flush=True)
            if args.shots:
                args.shots.mkdir(parents=True, exist_ok=True)
                firefox.picture(args.shots / f"firefox_{test.__name__}.png")
        if firefox.errors:
            sys.exit(f"FAILED: errors in Firefox's console: {firefox.errors}")
    print("The page is sound in Firefox.")


main()
