"""Chromium without a window, for tests of pages."""

import base64
import json
import os
import shutil
import subprocess
import time

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = ["--headless=new", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run", "--hide-scrollbars"]


class Browser:
    """Chromium spoken to over its debugging pipe: messages of JSON that end with a zero byte."""

    def __init__(self, program, profile):
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()

        def place_pipes():
            # First out of the way of 3 and 4, which either may be.
            a, b = os.dup(to_browser), os.dup(from_browser)
            os.dup2(a, 3)
            os.dup2(b, 4)

        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        self.process = subprocess.Popen([program, *FLAGS, *root, "--remote-debugging-pipe", f"--user-data-dir={profile}"], preexec_fn=place_pipes,
                                        close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._rest, self._next, self.events, self._session = b"", 0, [], None

    def open(self, width, height, phone=False):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)

    def call(self, method, **params):
        self._next += 1
        message = {"id": self._next, "method": method, "params": params}
        if self._session and not method.startswith("Target."):
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive()
            if answer.get("id") == self._next:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def _receive(self):
        while b"\0" not in self._rest:
            data = os.read(self._in, 1 << 20)
            if not data:
                raise RuntimeError("the browser has ended")
            self._rest += data
        text, self._rest = self._rest.split(b"\0", 1)
        return json.loads(text)

    def run(self, script):
        """Value of an expression; waits for promises."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def picture(self, file=None, whole=False):
        data = base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"])
        if file:
            with open(file, "wb") as out:
                out.write(data)
        return data

    def close(self):
        self.process.terminate()
        self.process.wait(20)


def wait_for(browser, condition, seconds=30):
    end = time.monotonic() + seconds
    while not browser.run(condition):
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s: {condition}")
        time.sleep(0.05)


def check_silence(browser, page, allowed=("file://", "data:", "blob:"), refused=()):
    """No error was reported and no request went anywhere but where it may. refused: ends of addresses that may answer 400"""
    wrong = []
    for e in browser.events:
        p = e.get("params", {})
        if e.get("method") == "Runtime.exceptionThrown":
            wrong.append(p["exceptionDetails"].get("exception", {}).get("description", str(p)))
        if e.get("method") == "Log.entryAdded" and p["entry"]["level"] == "error" and not ("status of 400" in p["entry"]["text"] and p["entry"].get("url", "-").endswith(tuple(refused))):
            wrong.append(p["entry"]["text"])
        if e.get("method") == "Runtime.consoleAPICalled" and p["type"] == "error":
            wrong.append(str(p["args"]))
        if e.get("method") == "Network.requestWillBeSent" and not p["request"]["url"].startswith(allowed):
            wrong.append("requests " + p["request"]["url"])
    assert not wrong, f"{page}: " + "; ".join(wrong)


def set_value(browser, selector, value, event):
    browser.run(f"""(() => {{ const e = document.querySelector({json.dumps(selector)}); e.value = {json.dumps(value)};
        e.dispatchEvent(new Event({json.dumps(event)}, {{ bubbles: true }})); }})()""")
    time.sleep(0.3)


def click(browser, selector):
    browser.run(f"document.querySelector({json.dumps(selector)}).click()")
    time.sleep(0.3)


def mouse_click(browser, x, y):
    for kind in ("mousePressed", "mouseReleased"):
        browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
    time.sleep(0.5)


def find_browser():
    return next((p for p in map(shutil.which, BROWSERS) if p), None)
