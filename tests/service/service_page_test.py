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


def field(key):
    return f"document.getElementById('key-{key}')"


def edit(browser, key, value):
    browser.run(f"(() => {{ const e = {field(key)}; e.value = {json.dumps(value)}; e.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()")
    wait_for(browser, "document.querySelector('#parameters').dataset.ready === 'yes'")


def on_parameters(browser):
    wait_for(browser, "document.querySelector('#parameters').dataset.ready === 'yes' && !document.querySelector('#parameters').hidden")


def fill_in_parameters(browser, keep):
    """The form of all keys: values of the scene, search, changes, the program's messages beside the keys."""
    set_value(browser, "#scene", "two_cells", "change")
    set_value(browser, "#set", "", "input")
    click(browser, "#ask-parameters")
    on_parameters(browser)
    assert browser.run("document.querySelectorAll('.parameter').length") > 150
    assert browser.run(f"{field('time.end')}.value") == "2 h" and browser.run(f"{field('cell_types.hepatocyte.dcm.nodes')}.value") == "162"
    about = browser.run(f"{field('cell_types.hepatocyte.adhesion')}.closest('.parameter').textContent")
    assert "adhesion energy per area" in about and "J/m^2" in about and "range >= 0" in about, about
    set_value(browser, "#parameters input[type=search]", "adhesion energy", "input")
    seen = browser.run("[...document.querySelectorAll('.parameter')].filter((e) => e.offsetParent).map((e) => e.querySelector('code').textContent)")
    assert "cell_types.hepatocyte.adhesion" in seen and "time.end" not in seen, seen
    browser.picture(keep and f"{keep}/parameters_search.png")
    set_value(browser, "#parameters input[type=search]", "", "input")
    edit(browser, "time.end", "20 min")
    edit(browser, "cell_types.hepatocyte.dcm.nodes", "42")
    assert browser.run("document.querySelector('#set').value") == "time.end = 20 min\ncell_types.hepatocyte.dcm.nodes = 42"
    assert "2 values differ" in browser.run("document.querySelector('.verdict').textContent")
    edit(browser, "time.end", "3 kg")
    said = browser.run(f"{field('time.end')}.closest('.parameter').querySelector('.fault').textContent")
    assert said.startswith("/time/end") and 'unknown unit "kg"' in said, said
    browser.run(f"{field('time.end')}.scrollIntoView({{ block: 'center' }})")
    browser.picture(keep and f"{keep}/parameters_fault.png")
    edit(browser, "time.end", "2 h")
    edit(browser, "cell_types.hepatocyte.dcm.nodes", "162")
    assert browser.run("document.querySelector('#set').value") == "", "a value of the scene is sent as a change"
    assert browser.run("document.querySelectorAll('.parameter.wrong, .parameter.changed').length") == 0
    browser.run("window.scrollTo(0, 0)")
    browser.picture(keep and f"{keep}/parameters.png")
    fits(browser)


def look_at_the_start(browser, keep):
    """The start is drawn without a run; faults of the scene are told instead."""
    before = browser.run("document.querySelectorAll('#runs a').length")
    set_value(browser, "#scene", "lobule_hybrid", "change")
    set_value(browser, "#set", "", "input")
    click(browser, "#ask-preview")
    wait_for(browser, "document.querySelector('#preview .stage canvas') != null && document.querySelector('#preview').dataset.ready != null", 60)
    facts = browser.run("document.querySelector('#preview .facts').textContent")
    assert "28 deformable, 57 spheres" in facts and "start-up" in facts, facts
    time.sleep(0.5)
    blank = browser.run("(() => { const c = document.querySelector('#preview canvas'), d = document.createElement('canvas'); d.width = c.width; d.height = c.height; return c.toDataURL() === d.toDataURL(); })()")
    assert not blank, "nothing is drawn"
    browser.run("window.scrollTo(0, 0)")
    browser.picture(keep and f"{keep}/preview.png")
    fits(browser)
    set_value(browser, "#set", "cells.cout = 3", "input")
    click(browser, "#ask-preview")
    wait_for(browser, "document.querySelector('#preview [role=alert]')?.textContent.includes('/cells/cout')")
    set_value(browser, "#set", "", "input")
    assert browser.run("document.querySelectorAll('#runs a').length") == before, "a preview made a run"


def compare_runs(browser, keep):
    start_run(browser, "two_cells", "time.end = 30 min\noutput.every = 2 min\nseed = 2", "another pair")
    wait_for(browser, f"{BADGE} === 'completed' && document.querySelector('#run h2').textContent === 'another pair'")
    push(browser, "Compare with")
    wait_for(browser, "document.querySelector('#compare iframe') != null && !document.querySelector('#compare').hidden")
    assert "another pair and a pair" in browser.run("document.querySelector('#compare .headline').textContent")
    time.sleep(5)  # its page is of another origin: only looked at
    browser.run("window.scrollTo(0, 0)")
    browser.picture(keep and f"{keep}/compare.png")
    fits(browser)
    click(browser, "#compare .headline a")
    wait_for(browser, "!document.querySelector('#run').hidden && document.querySelector('#run h2').textContent === 'another pair'")


def look_on_a_phone(browser, keep):
    """The new pages at the width of a phone."""
    set_value(browser, "#scene", "lobule_hybrid", "change")
    click(browser, "#ask-parameters")
    on_parameters(browser)
    set_value(browser, "#parameters input[type=search]", "leader", "input")
    time.sleep(1)
    fits(browser)
    browser.picture(keep and f"{keep}/parameters_phone.png")
    set_value(browser, "#parameters input[type=search]", "", "input")
    browser.run("document.querySelector('#preview').removeAttribute('data-ready')")
    click(browser, "#ask-preview")
    wait_for(browser, "document.querySelector('#preview .stage canvas') != null && document.querySelector('#preview').dataset.ready != null", 60)
    time.sleep(1)
    fits(browser)
    browser.picture(keep and f"{keep}/preview_phone.png")
    two = browser.run("[...document.querySelectorAll('#runs a')].filter((a) => /pair/.test(a.textContent)).map((a) => a.getAttribute('href').slice(1))")
    browser.run(f"location.hash = 'compare/{two[0]}/{two[1]}'")
    wait_for(browser, "!document.querySelector('#compare').hidden")
    time.sleep(4)
    fits(browser)
    browser.picture(keep and f"{keep}/compare_phone.png")


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
            browser.open(1400, 900)
            log_in(browser, service)
            watch_a_run(browser, arguments.keep)
            clone_a_run(browser)
            compare_runs(browser, arguments.keep)
            fill_in_parameters(browser, arguments.keep)
            look_at_the_start(browser, arguments.keep)
            stop_and_resume(browser, arguments.keep)
            use_the_keyboard(browser)
            fits(browser)
            browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
            time.sleep(0.5)
            fits(browser)
            browser.picture(arguments.keep and f"{arguments.keep}/service_phone.png", whole=True)
            look_on_a_phone(browser, arguments.keep)
            check_silence(browser, "service", (f"http://127.0.0.1:{service.port}/", "data:", "blob:"), ("/check", "/preview"))
            set_value(browser, "#set", "time.ende = 1 h", "input")
            click(browser, "#new button")
            wait_for(browser, "document.querySelector('#fault').textContent.includes('time.end')")
        finally:
            browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
