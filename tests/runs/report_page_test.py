"""Opens pages of `acinus report` in a browser, as a user would, and operates everything on them.

usage: report_page_test.py ACINUS [--keep FOLDER] [PAGE.html ...]

Without pages a small hybrid run is made first, and a page of it alone and beside itself. No error in the console, no
request but for the page, every control does something. Pictures go to --keep. Exit code 77 without Chromium.
"""

import argparse
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
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


def load(browser, page):
    """@return seconds until the first picture"""
    start = time.monotonic()
    browser.call("Page.navigate", url="file://" + os.path.abspath(page))
    wait_for(browser, "document.body?.dataset.ready != null")
    assert browser.run("document.body.dataset.ready") == "yes", "the page's script failed"
    return time.monotonic() - start


def check_silence(browser, page):
    """No error was told and nothing was asked from anywhere."""
    wrong = []
    for e in browser.events:
        p = e.get("params", {})
        if e.get("method") == "Runtime.exceptionThrown":
            wrong.append(p["exceptionDetails"].get("exception", {}).get("description", str(p)))
        if e.get("method") == "Log.entryAdded" and p["entry"]["level"] == "error":
            wrong.append(p["entry"]["text"])
        if e.get("method") == "Runtime.consoleAPICalled" and p["type"] == "error":
            wrong.append(str(p["args"]))
        if e.get("method") == "Network.requestWillBeSent" and not p["request"]["url"].startswith(("file://", "data:", "blob:")):
            wrong.append("asks for " + p["request"]["url"])
    assert not wrong, f"{page}: " + "; ".join(wrong)


def canvas(browser):
    """Bytes of what is drawn in 3D."""
    return browser.run("document.querySelector('.stage canvas').toDataURL()")


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


def operate_viewer(browser):
    seen = canvas(browser)

    def changed(what):
        nonlocal seen
        now = canvas(browser)
        assert now != seen, f"{what} changes nothing in the picture"
        seen = now

    last = browser.run("document.querySelector('.time input').max")
    if int(last) > 0:
        set_value(browser, ".time input", "0", "input")
        changed("the frame slider")
        click(browser, ".play")
        time.sleep(0.6)
        click(browser, ".play")
        assert int(browser.run("document.querySelector('.time input').value")) > 0, "play does not play"
        set_value(browser, ".time input", last, "input")
        seen = canvas(browser)
    for field in browser.run("[...document.querySelector('#field').options].map((o) => o.value)"):
        set_value(browser, "#field", field, "change")
        assert browser.run("document.querySelector('.legend').textContent") != "", f"{field}: no legend"
    set_value(browser, "#field", "pressure", "change")
    changed("colour")
    for axis in "xyz":
        set_value(browser, "#cut", axis, "change")
        changed("cut " + axis)
    set_value(browser, "[aria-label^=Position]", "0.3", "input")
    changed("the position of the cut")
    set_value(browser, "#cut", "off", "change")
    seen = canvas(browser)
    for k in range(browser.run("document.querySelectorAll('.check input').length")):
        before = canvas(browser)
        browser.run(f"document.querySelectorAll('.check input')[{k}].click()")
        browser.run(f"document.querySelectorAll('.check input')[{k}].click()")
        assert canvas(browser) == before, "a model switched off and on looks different"
    browser.run("document.querySelector('.stage canvas').focus()")
    for key in ("ArrowLeft", "ArrowUp"):
        browser.call("Input.dispatchKeyEvent", type="keyDown", key=key)
    browser.call("Input.dispatchKeyEvent", type="keyDown", key="+", text="+")
    changed("the keyboard")
    click(browser, ".reset")
    changed("reset")
    pick_a_cell(browser)


def pick_a_cell(browser):
    box = browser.run("(() => { window.scrollTo(0, 0); const b = document.querySelector('.stage canvas').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
    views = int(browser.run("document.querySelector('.stage').dataset.views"))
    for share in (0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65):
        mouse_click(browser, box[0] + box[2] / views * 0.5, box[1] + share * box[3])
        if not browser.run("document.querySelector('.cell').hidden"):
            break
    else:
        raise AssertionError("no click finds a cell")
    wait_for(browser, "document.querySelectorAll('.cell td').length > 10 && document.querySelector('.cell canvas') != null")


def operate_rest(browser):
    for name in browser.run("[...(document.querySelector('#observable')?.options ?? [])].map((o) => o.value)")[:20]:
        browser.run(f"""(() => {{ const e = document.querySelector('#observable'); e.value = {json.dumps(name)}; e.dispatchEvent(new Event('change')); }})()""")
    browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    browser.run("(async () => { for (let y = 0; y < document.body.scrollHeight; y += 500) { window.scrollTo(0, y); await new Promise((r) => setTimeout(r, 60)); } })()")
    # Plots are drawn once they come near the window.
    wait_for(browser, "[...document.querySelectorAll('.plot')].every((p) => p.querySelector('canvas, img') != null)", 15)
    wide = browser.run("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert wide <= 0, f"the page is {wide} px wider than the window"


def try_page(browser, page, keep):
    name = os.path.splitext(os.path.basename(page))[0]
    browser.events.clear()
    browser.call("Emulation.setDeviceMetricsOverride", width=1400, height=1000, deviceScaleFactor=1, mobile=False)
    seconds = load(browser, page)
    if browser.run("document.querySelector('.stage') != null"):
        operate_viewer(browser)
        browser.picture(keep and f"{keep}/{name}_picked.png")
    operate_rest(browser)
    browser.picture(keep and f"{keep}/{name}_all.png", whole=True)
    browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
    load(browser, page)
    operate_rest(browser)
    browser.run("window.scrollTo(0, 0)")
    browser.picture(keep and f"{keep}/{name}_phone.png")
    check_silence(browser, page)
    print(f"{name}: {os.path.getsize(page) / 1e6:.1f} MB, first picture after {seconds:.2f} s")


def make_pages(acinus, folder):
    run = os.path.join(folder, "small.run")
    subprocess.run([acinus, "run", "lobule_hybrid", "--set", "start_up.growth_time=30 min", "--set", "output.every=10 min", "--until", "30 min",
                    "--threads", "1", "--out", run, "--quiet"], check=True)
    pages = [os.path.join(folder, name) for name in ("one.html", "two.html")]
    subprocess.run([acinus, "report", run, "--out", pages[0], "--quiet"], check=True)
    subprocess.run([acinus, "report", run, run + "/", "--out", pages[1], "--quiet"], check=True)
    return pages


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("acinus")
    parser.add_argument("pages", nargs="*")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    program = next((p for p in map(shutil.which, BROWSERS) if p), None)
    if not program:
        print("no Chromium: not tested")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        pages = arguments.pages or make_pages(os.path.abspath(arguments.acinus), folder)
        browser = Browser(program, os.path.join(folder, "profile"))
        try:
            browser.open(1400, 1000)
            for page in pages:
                try_page(browser, page, arguments.keep)
        finally:
            browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
