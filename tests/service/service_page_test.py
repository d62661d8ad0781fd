"""Uses the page of a service in a browser: logs in, starts runs, watches, stops, resumes, looks at one in 3D.

usage: service_page_test.py ACINUS [--keep FOLDER]

Pictures go to --keep. Exit code 77 without Chromium.
"""

import argparse
import json
import os
import sys
import tempfile
import time

from browser import Browser, check_silence, click, find_browser, set_value, wait_for
from service_client import Service

BADGE = "document.querySelector('#run .badge')?.textContent"


def press(browser, key, text=None):
    extra = {"text": text} if text else {}
    browser.call("Input.dispatchKeyEvent", type="keyDown", key=key, code=key, windowsVirtualKeyCode={"Enter": 13, "Tab": 9}.get(key, 0), **extra)
    browser.call("Input.dispatchKeyEvent", type="keyUp", key=key, code=key)
    time.sleep(0.1)


def start_run(browser, scene, changes, name):
    set_value(browser, "#scene", scene, "change")
    set_value(browser, "#set", changes, "input")
    set_value(browser, "#name", name, "input")
    click(browser, "#new button")


def push(browser, text):
    """Clicks the button of the chosen run that says so."""
    wait_for(browser, f"[...document.querySelectorAll('#run .actions button')].some((b) => b.textContent === {json.dumps(text)})")
    browser.run(f"[...document.querySelectorAll('#run .actions button')].find((b) => b.textContent === {json.dumps(text)}).click()")


def fits(browser):
    wide = browser.run("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert wide <= 0, f"the page is {wide} px wider than the window"


def log_in(browser, service):
    browser.call("Page.navigate", url=f"http://127.0.0.1:{service.port}/login#{service.token}")
    wait_for(browser, "document.body?.dataset.ready === 'yes' && document.querySelectorAll('#scene option').length > 10")
    assert service.token not in browser.run("location.href")
    assert browser.run("document.cookie") == "", "scripts can read the cookie"


def watch_a_run(browser, keep):
    start_run(browser, "two_cells", "time.end = 30 min\noutput.every = 2 min", "a pair")
    wait_for(browser, f"{BADGE} === 'completed'")
    wait_for(browser, "document.querySelectorAll('#run .plot canvas').length === 2")
    assert browser.run("document.querySelectorAll('#run .files a').length") >= 5
    for name in browser.run("[...document.querySelector('#run .pick select').options].map((o) => o.value)")[:6]:
        set_value(browser, "#run .pick select", name, "change")
    push(browser, "Show in 3D")
    wait_for(browser, "document.querySelector('#run iframe') != null")
    time.sleep(4)  # its page is of another origin: only looked at
    browser.picture(keep and f"{keep}/service_3d.png")
    frames = [t["url"] for t in browser.call("Target.getTargets")["targetInfos"] if t["type"] == "iframe"]
    assert len(frames) == 1 and frames[0].endswith("/report"), frames


def clone_a_run(browser):
    """The form gets the scene, changes and name of the chosen run."""
    set_value(browser, "#scene", "pull_off", "change")
    set_value(browser, "#set", "", "input")
    push(browser, "Clone")
    wait_for(browser, "document.querySelector('#set').value !== ''")
    form = browser.run("['scene', 'set', 'name'].map((id) => document.querySelector('#' + id).value)")
    assert form[0] == "two_cells" and form[2] == "a pair", form
    assert sorted(line.split("=")[0].strip() for line in form[1].split("\n")) == ["output.every", "time.end"], form


def stop_and_resume(browser, keep):
    start_run(browser, "lobule_hybrid", "start_up.growth_time = 30 min\ntime.end = 10 min\noutput.every = 2 min", "")
    wait_for(browser, f"{BADGE} === 'running'")
    wait_for(browser, "document.querySelector('#run .facts').textContent.includes('start-up')")
    browser.picture(keep and f"{keep}/service_running.png")
    push(browser, "Stop")
    wait_for(browser, f"{BADGE} === 'stopped'")
    push(browser, "Resume")
    wait_for(browser, f"{BADGE} === 'completed'", 60)
    wait_for(browser, "document.querySelectorAll('#run .plot canvas').length === 2")
    browser.run("window.scrollTo(0, 0)")
    browser.picture(keep and f"{keep}/service_done.png")


def use_the_keyboard(browser):
    """Only keys: to the form, a change typed, Enter on the button."""
    set_value(browser, "#scene", "two_cells", "change")
    set_value(browser, "#set", "", "input")
    browser.run("document.querySelector('#set').focus()")
    for letter in "time.end=5 min":
        browser.call("Input.dispatchKeyEvent", type="char", text=letter)
    press(browser, "Tab")
    press(browser, "Tab")
    assert browser.run("document.activeElement.textContent") == "Start", "Tab does not reach the button"
    before = browser.run("location.hash")
    press(browser, "Enter", "\r")
    wait_for(browser, f"location.hash !== {json.dumps(before)}")
    wait_for(browser, f"{BADGE} === 'completed'")
    browser.run("document.querySelector('#runs a').focus()")
    time.sleep(1.5)
    assert browser.run("document.activeElement.matches('#runs a')"), "the list loses the focus when it is renewed"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("acinus")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    program = find_browser()
    if not program:
        print("no Chromium: not tested")
        return 77
    with tempfile.TemporaryDirectory() as folder, Service(os.path.abspath(arguments.acinus), folder + "/data", "--jobs", "1") as service:
        browser = Browser(program, os.path.join(folder, "profile"))
        try:
            browser.open(1400, 1000)
            log_in(browser, service)
            watch_a_run(browser, arguments.keep)
            clone_a_run(browser)
            stop_and_resume(browser, arguments.keep)
            use_the_keyboard(browser)
            fits(browser)
            browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
            time.sleep(0.5)
            fits(browser)
            browser.picture(arguments.keep and f"{arguments.keep}/service_phone.png", whole=True)
            check_silence(browser, "service", (f"http://127.0.0.1:{service.port}/", "data:", "blob:"))
            set_value(browser, "#set", "time.ende = 1 h", "input")
            click(browser, "#new button")
            wait_for(browser, "document.querySelector('#fault').textContent.includes('time.end')")
        finally:
            browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
