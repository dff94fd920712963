# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Chromium without a window, asked through two pipes: what a page shows, and what it says on its console."""
import base64
import io
import json
import os
import select
import shutil
import subprocess
import tempfile

import numpy as np

# WebGL by the processor, so that no graphics card is needed
OPTIONS = ("--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox",
           "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking", "--remote-debugging-pipe")
SECONDS = 60  # after so many it does not answer any more


def chromium():
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Browser:
    """One page. Messages are JSON, with a zero between them, as the protocol of its developer tools wants them."""

    def __init__(self, width, height):
        self.home = tempfile.mkdtemp(prefix="conetact-browser-")
        asked, self.ask = os.pipe()
        self.answer, answered = os.pipe()
        # the browser reads from 3 and writes to 4
        words = [chromium(), *OPTIONS, f"--user-data-dir={self.home}", "about:blank"]
        self.process = subprocess.Popen(["/bin/sh", "-c", f'exec "$@" 3<&{asked} 4>&{answered}', "sh", *words],
                                        pass_fds=(asked, answered), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(asked)
        os.close(answered)
        self.rest, self.number, self.session, self.said = b"", 0, None, []
        self.loaded = None  # which page has been loaded last, as the browser numbers them
        self._attach(width, height)

    def _attach(self, width, height):
        # a page of our own: the first one of the browser may still be on its way to its address
        page = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.call("Page.setLifecycleEventsEnabled", enabled=True)
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.ask, json.dumps(message).encode() + b"\0")
        while True:
            found = self._next()
            if found.get("id") == self.number:
                if "error" in found:
                    raise RuntimeError(f"{method}: {found['error']['message']}")
                return found["result"]

    def _next(self):
        while b"\0" not in self.rest:
            if not select.select([self.answer], [], [], SECONDS)[0]:
                raise RuntimeError(f"The browser has not answered for {SECONDS} s.")
            part = os.read(self.answer, 1 << 20)
            if not part:
                raise RuntimeError("The browser has ended.")
            self.rest += part
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        self._listen(message)
        return message

    def _listen(self, message):
        """Keeps errors and warnings of the page, and which page has been loaded."""
        values = message.get("params", {})
        if message.get("method") == "Page.lifecycleEvent" and values["name"] == "load":
            self.loaded = values["loaderId"]
        elif message.get("method") == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            self.said.append(details.get("exception", {}).get("description", details["text"]))
        elif message.get("method") == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self.said.append(values["entry"]["text"])
        elif message.get("method") == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning"):
            self.said.append(str(values["args"]))

    def open(self, file):
        """Shows a page, and waits until this page, not the one before, has been loaded."""
        page = self.call("Page.navigate", url=file.resolve().as_uri())["loaderId"]
        while self.loaded != page:
            self._next()
        self.settle()

    def run(self, text):
        done = self.call("Runtime.evaluate", expression=text, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in done:
            raise RuntimeError(str(done["exceptionDetails"].get("exception", done)))
        return done["result"].get("value")

    def settle(self):
        """Until the page has drawn twice."""
        self.run("new Promise((good) => requestAnimationFrame(() => requestAnimationFrame(good)))")

    def picture(self):
        """What is seen, as numbers from 0 to 255 by height, width and colour."""
        from matplotlib.image import imread
        data = base64.b64decode(self.call("Page.captureScreenshot")["data"])
        return (imread(io.BytesIO(data), format="png")[:, :, :3] * 255).astype(np.uint8)

    def drag(self, start, end):
        self.mouse("mousePressed", start, button="left", clickCount=1)
        for w in (.25, .5, .75, 1):
            self.mouse("mouseMoved", [(1 - w) * a + w * b for a, b in zip(start, end)], button="left", buttons=1)
        self.mouse("mouseReleased", end, button="left", clickCount=1)
        self.settle()

    def mouse(self, kind, place, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], **more)

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.ask)
        os.close(self.answer)
        shutil.rmtree(self.home, ignore_errors=True)
