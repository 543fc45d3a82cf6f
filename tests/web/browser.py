"""Chromium without a display, steered by its debugging protocol: pages, real mouse, key and touch events, pictures."""
import base64
import json
import pathlib
import shutil
import subprocess
import tempfile
import time
import urllib.request

import websocket  # python3-websocket

FLAGS = ["--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
         "--no-sandbox", "--no-first-run", "--disable-background-networking", "--mute-audio", "--remote-allow-origins=*"]


class Browser:
    """Ends with its `with` block."""

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="tyglab-chromium-")
        self.process = subprocess.Popen(["chromium", *FLAGS, f"--user-data-dir={self.folder}", "--remote-debugging-port=0", "about:blank"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file, end = pathlib.Path(self.folder) / "DevToolsActivePort", time.monotonic() + 60
        while not port_file.exists() or not port_file.read_text().strip():
            if time.monotonic() > end:
                raise RuntimeError("chromium did not start within a minute")
            time.sleep(0.1)
        self.port = int(port_file.read_text().split()[0])
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(30)
        shutil.rmtree(self.folder, ignore_errors=True)

    def page(self, address, width=1280, height=720, scale=1, touch=False, script="", blocked=()):
        """`script` runs before the page's own; addresses that match `blocked` do not load."""
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}/json/new?about:blank", method="PUT")
        with urllib.request.urlopen(request) as answer:
            page = Page(json.load(answer)["webSocketDebuggerUrl"])
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
        if touch:
            page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        page.call("Page.bringToFront")
        page.call("Emulation.setFocusEmulationEnabled", enabled=True)
        page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        if blocked:
            page.call("Network.setBypassServiceWorker", bypass=True)
            page.call("Network.setCacheDisabled", cacheDisabled=True)
            page.call("Network.setBlockedURLs", urls=list(blocked))
        page.call("Page.navigate", url=address)
        return page


class Page:
    def __init__(self, address):
        self.socket = websocket.create_connection(address, timeout=120)
        self.number, self.errors, self.choosers, self.traced, self.tracing = 0, [], [], [], False
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self.call(f"{domain}.enable")

    def send(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))

    def call(self, method, **parameters):
        self.send(method, **parameters)
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.note(message)

    def note(self, message):
        """Errors of the console and of scripts."""
        kind, said = message.get("method"), message.get("params", {})
        if kind == "Runtime.exceptionThrown":
            self.errors.append(said["exceptionDetails"].get("exception", {}).get("description") or said["exceptionDetails"]["text"])
        elif kind == "Runtime.consoleAPICalled" and said["type"] == "error":
            self.errors.append(" ".join(str(argument.get("value", argument.get("description"))) for argument in said["args"]))
        elif kind == "Page.fileChooserOpened":
            self.choosers.append(said["backendNodeId"])
        elif kind == "Tracing.dataCollected":
            self.traced += said["value"]
        elif kind == "Tracing.tracingComplete":
            self.tracing = False
        elif kind == "Log.entryAdded" and said["entry"]["level"] == "error":
            self.errors.append(said["entry"]["text"] + " " + said["entry"].get("url", ""))

    def ask(self, expression):
        """A JavaScript expression's value, waited for."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait(self, expression, seconds=60):
        end = time.monotonic() + seconds
        while not self.ask(expression):
            if time.monotonic() > end:
                raise RuntimeError(f"not within {seconds} s: {expression}")
            time.sleep(0.1)

    def trace(self):
        """Begins to record what the browser's threads do."""
        self.traced, self.tracing = [], True
        self.call("Tracing.start", transferMode="ReportEvents",
                  traceConfig={"includedCategories": ["devtools.timeline", "disabled-by-default-devtools.timeline"]})

    def frames_traced(self, seconds=60):
        """Of a page that is the only one to draw, since then, ms: when its frames began, the processor time that it took itself
        for each, and that of its longest task of any kind. Without what draws, which is another process, and without waiting
        for it or for a processor. The page asks for one frame at a time."""
        self.call("Tracing.end")
        end = time.monotonic() + seconds
        while self.tracing:
            self.ask("1")
            if time.monotonic() > end:
                raise RuntimeError("the trace does not end")
        frames = [event for event in self.traced if event["name"] == "FireAnimationFrame" and "tdur" in event]
        threads = {(event["pid"], event["tid"]) for event in frames}
        tasks = [event["tdur"] / 1000 for event in self.traced
                 if event["name"] == "RunTask" and "tdur" in event and (event["pid"], event["tid"]) in threads]
        return [event["ts"] / 1000 for event in frames], [event["tdur"] / 1000 for event in frames], max(tasks)

    def started(self):
        self.wait("performance.getEntriesByName('tyglab first frame').length > 0", 120)
        time.sleep(0.5)

    def mouse(self, kind, x, y, button="none", held=0, modifiers=0):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=held, clickCount=int(kind != "mouseMoved"),
                  modifiers=modifiers)

    def drag(self, start, to, button="left", steps=12, hold=0.5):
        held = {"left": 1, "right": 2, "middle": 4}[button]
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, button, held)
        for step in range(1, steps + 1):
            self.mouse("mouseMoved", *(a + (b - a) * step / steps for a, b in zip(start, to)), button, held)
            time.sleep(0.03)
        time.sleep(hold)
        yield
        self.mouse("mouseReleased", *to, button)

    def click(self, x, y):
        for kind, held in [("mouseMoved", 0), ("mousePressed", 1), ("mouseReleased", 0)]:
            self.mouse(kind, x, y, "none" if kind == "mouseMoved" else "left", held)
        time.sleep(0.4)

    def key(self, key, code, number, modifiers=0, text=None):
        common = {"key": key, "code": code, "windowsVirtualKeyCode": number, "modifiers": modifiers}
        self.call("Input.dispatchKeyEvent", type="keyDown", **common, **({"text": text} if text else {}))
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def type(self, text):
        for letter in text:
            code = f"Key{letter.upper()}" if letter.isalpha() else "Space" if letter == " " else f"Digit{letter}"
            self.key(letter, code, ord(letter.upper()), text=letter)
            time.sleep(0.03)

    def touch(self, kind, *points):
        """As a hand does: only the end waits for the page, whose frames may take longer than the pause between moves."""
        tell = self.call if kind == "touchEnd" else self.send
        tell("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(points)])

    def picture(self, file):
        pathlib.Path(file).write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
