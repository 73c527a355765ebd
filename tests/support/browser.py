"""Headless Chromium, told what to do over its DevTools pipe (JSON and a NUL, file descriptors 3 and 4)."""
from __future__ import annotations

import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE = 120.0  # nothing here is timed: how long a slow machine may take before we call it broken
# ANGLE on the driver that the program draws with, so that both sides do the same arithmetic.
FLAGS = ("--headless", "--no-sandbox", "--no-first-run", "--ignore-gpu-blocklist", "--disable-gpu-watchdog", "--use-gl=angle",
         "--use-angle=gl-egl", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--proxy-server=127.0.0.1:1", "--window-size=1000,1000", "--remote-debugging-pipe")


def program() -> str | None:
    return shutil.which("chromium")


class Browser:
    """One page at a time; `requests` are the addresses that the page asked for, `complaints` what went wrong in it."""

    def __init__(self) -> None:
        self.folder = tempfile.TemporaryDirectory(prefix="tidemark-browser-", ignore_cleanup_errors=True)
        to_child, self.writer = os.pipe()
        self.reader, from_child = os.pipe()
        # The child's own 3 and 4, whatever ours are called.
        words = ["bash", "-c", f'exec 3<&{to_child} 4>&{from_child}; exec "$0" "$@"', program(), *FLAGS,
                 f"--user-data-dir={self.folder.name}", "about:blank"]
        self.process = subprocess.Popen(words, pass_fds=[to_child, from_child], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, env=dict(os.environ, HOME=self.folder.name),
                                        start_new_session=True)
        os.close(to_child)
        os.close(from_child)
        self.received, self.number, self.session, self.requests, self.complaints = b"", 0, None, [], []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Network", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def close(self) -> None:
        os.close(self.writer)
        self.process.terminate()
        self.process.wait()
        os.close(self.reader)
        self.folder.cleanup()

    def call(self, method: str, **parameters):
        """What the browser answers; what it tells meanwhile is taken note of."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.writer, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("method") == "Network.requestWillBeSent":
                self.requests.append(answer["params"]["request"]["url"])
            if answer.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded"):
                self.complaints.append(answer["params"])
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def _next(self) -> dict:
        while b"\0" not in self.received:
            if not select.select([self.reader], [], [], PATIENCE)[0]:
                raise AssertionError("the browser does not answer")
            more = os.read(self.reader, 1 << 20)
            if not more:
                raise AssertionError("the browser ended")
            self.received += more
        message, _, self.received = self.received.partition(b"\0")
        return json.loads(message)

    def evaluate(self, script: str):
        """Its value, awaited."""
        done = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in done:
            raise AssertionError(done["exceptionDetails"].get("exception", {}).get("description", str(done)))
        return done["result"].get("value")

    def open(self, address: str) -> None:
        self.requests, self.complaints = [], []
        self.call("Page.navigate", url="about:blank")  # another fragment of the same page would load nothing
        self.wait_for("location.href === 'about:blank'")
        self.call("Page.navigate", url=address)
        self.wait_for(f"location.href !== 'about:blank' && document.readyState === 'complete'")

    def wait_for(self, script: str):
        """What the script gives once that is true."""
        deadline = time.monotonic() + PATIENCE
        while not (found := self.evaluate(script)):
            if time.monotonic() > deadline:
                raise AssertionError(f"waited {PATIENCE:.0f} s in vain for {script}")
            time.sleep(0.02)
        return found

    def mouse(self, kind: str, x: float, y: float, **more) -> None:
        """kind: mousePressed, mouseMoved, mouseReleased; from the page's top left."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def screenshot(self, width: int, height: int, dark: bool = False) -> str:
        """The page in a window of that size, PNG in base 64."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        return self.call("Page.captureScreenshot", format="png")["data"]
