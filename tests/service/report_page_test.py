"""Opens pages of `acinus report` in a browser, as a user would, and operates everything on them.

usage: report_page_test.py ACINUS [--keep FOLDER] [PAGE.html ...]

Without pages a small hybrid run is made first, and a page of it alone and beside another scene. No error in the console, no
request but for the page, every control does something. Pictures go to --keep. Exit code 77 without Chromium.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

from browser import Browser, check_silence, click, find_browser, mouse_click, set_value, wait_for

def load(browser, page):
    """@return seconds until the first picture"""
    start = time.monotonic()
    browser.call("Page.navigate", url="file://" + os.path.abspath(page))
    wait_for(browser, "document.body?.dataset.ready != null")
    assert browser.run("document.body.dataset.ready") == "yes", "the page's script failed"
    return time.monotonic() - start


def canvas(browser):
    """Bytes of what is drawn in 3D."""
    return browser.run("document.querySelector('.stage canvas').toDataURL()")


def check_fit(browser):
    """At the start all cells and obstacles are inside the picture, and a scale bar says how large they are."""
    outside = browser.run("""(() => {
      const v = window.acinusViewer;
      let out = 0;
      for (const m of v.models) if (m.isCompact()) m.forEachDrawn((x, y, z) => {
        const p = v.camera.position.clone().set(x, y, z).project(v.camera);
        if (Math.abs(p.x) > 1 || Math.abs(p.y) > 1) ++out;
      });
      return out;
    })()""")
    assert outside == 0, f"{outside} points outside the picture at the start"
    assert browser.run("document.querySelector('.scale').textContent").endswith("µm"), "no scale bar"


def check_section(browser):
    """Every cell that the plane cuts has a face, and all faces lie in the plane."""
    wrong = browser.run("""(() => {
      for (const m of window.acinusViewer.models) {
        const n = m.section.geometry.getAttribute("position").count / 3;
        if (m.owner.length !== n) return `${m.owner.length} owners of ${n} triangles`;
        const height = [...m.section.geometry.getAttribute("position").array].map((x, k, all) => (k % 3 === 0 ? Math.abs(m.plane.normal.x * x + m.plane.normal.y * all[k + 1] + m.plane.normal.z * all[k + 2] + m.plane.constant) : 0));
        if (height.some((h) => h > 1e-2)) return "a face outside the plane";
        const { center, radius, id } = m.frame.sphere;
        const cut = [...id].filter((_, k) => Math.abs(m.plane.normal.x * center[3 * k] + m.plane.normal.y * center[3 * k + 1] + m.plane.normal.z * center[3 * k + 2] + m.plane.constant) < 0.5 * radius[k]);
        const mesh = new Map();
        m.frame.mesh.cell.forEach((cell, k) => {
          const h = m.plane.normal.x * m.frame.point[3 * k] + m.plane.normal.y * m.frame.point[3 * k + 1] + m.plane.normal.z * m.frame.point[3 * k + 2] + m.plane.constant;
          mesh.set(cell, [Math.min(h, mesh.get(cell)?.[0] ?? h), Math.max(h, mesh.get(cell)?.[1] ?? h)]);
        });
        for (const [cell, [low, high]] of mesh) if (low < -1 && high > 1) cut.push(cell);
        const faces = new Set(m.owner.map((o) => o.id));
        const open = cut.filter((cell) => !faces.has(cell));
        if (open.length > 0) return `cells ${open} are cut and have no face`;
      }
      return "";
    })()""")
    assert not wrong, wrong


def operate_viewer(browser):
    check_fit(browser)
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
    set_value(browser, "[aria-label^=Position]", "0.5", "input")
    check_section(browser)
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


def operate_fields(browser):
    """The slice of a field changes with time, axis and place of the cut, has its unit, and goes when the cut does."""
    if browser.run("document.querySelector('#slice') == null"):
        return
    [_, name, *_] = browser.run("[...document.querySelector('#slice').options].map((o) => o.value)")
    set_value(browser, "#slice", name, "change")
    assert browser.run("document.querySelector('#cut').value") == "y", "a slice makes no cut"
    legend = browser.run("document.querySelector('#slice').parentElement.querySelector('.legend').textContent")
    assert legend.endswith("mmHg"), f"no unit beside the colour bar: {legend}"
    seen = {canvas(browser)}
    for selector, value, event in ((".time input", "0", "input"), ("#cut", "x", "change"), ("[aria-label^=Position]", "0.2", "input")):
        set_value(browser, selector, value, event)
        assert canvas(browser) not in seen, f"{selector} does not change the slice"
        seen.add(canvas(browser))
    # Colours at the middle of the slice are those of the value there.
    wrong = browser.run("""(() => {
      const [m] = window.acinusViewer.models, { grid, mesh } = m.slice;
      if (!mesh.visible) return "no slice";
      const p = mesh.geometry.getAttribute("position").array, at = -m.plane.constant * m.plane.normal.x;
      if ([0, 3, 6, 9].some((k) => Math.abs(p[k] - at) > 1e-3)) return "not in the plane of the cut";
      const { width, height } = mesh.material.map.image;
      return width === grid.n[1] && height === grid.n[2] ? "" : `${width} x ${height} values`;
    })()""")
    assert not wrong, wrong
    set_value(browser, "#cut", "off", "change")
    assert browser.run("document.querySelector('#slice').value") == "", "the slice stays without a cut"
    set_value(browser, ".time input", browser.run("document.querySelector('.time input').max"), "input")
    click(browser, ".reset")


def operate_surface(browser):
    """The surface of a field has the level of its slider, changes with it and with time, and goes when it is not chosen."""
    if browser.run("document.querySelector('#surface') == null"):
        return
    without = canvas(browser)
    [_, name, *_] = browser.run("[...document.querySelector('#surface').options].map((o) => o.value)")
    set_value(browser, "#surface", name, "change")
    seen = {without, canvas(browser)}
    assert len(seen) == 2, "no surface is seen"
    text = "document.querySelector('#surface').parentElement.querySelector('output').textContent"
    assert browser.run(text).endswith("mmHg"), browser.run(text)
    for selector, value, event in (("[aria-label^=Level]", "0.8", "input"), (".time input", "0", "input")):
        set_value(browser, selector, value, event)
        assert canvas(browser) not in seen, f"{selector} does not change the surface"
        seen.add(canvas(browser))
    # Linear between two neighbouring middles of blocks, of which one is below and one above the level.
    wrong = browser.run("""(() => {
      const v = window.acinusViewer, [m] = v.models, { grid, group, parts: [mesh] } = m.surface;
      const [low, high] = v.surfaceRange, level = low + 0.8 * (high - low);
      const value = m.frame.fields[v.surface.value], p = mesh.geometry.getAttribute("position").array;
      if (!group.visible || (p.length === 0 && value.some((c) => c > level) && value.some((c) => c <= level))) return "no surface";
      for (let k = 0; k < p.length; k += 3) {
        const at = [0, 1, 2].map((a) => (p[k + a] - grid.low[a]) / grid.spacing[a] - 0.5);
        const ends = [Math.floor, Math.ceil].map((f) => at.map((x) => (Math.abs(x - Math.round(x)) < 1e-3 ? Math.round(x) : f(x))));
        const near = [];
        for (let c = 0; c < 8; ++c) {
          const [i, j, l] = [0, 1, 2].map((a) => ends[(c >> a) & 1][a]);
          near.push(value[i + grid.n[0] * (j + grid.n[1] * l)]);
        }
        const slack = 1e-3 * (high - low);
        if (Math.min(...near) > level + slack || Math.max(...near) < level - slack) return `a corner at ${at} is not at the level`;
      }
      return "";
    })()""")
    assert not wrong, wrong
    set_value(browser, "#surface", "", "change")
    set_value(browser, ".time input", browser.run("document.querySelector('.time input').max"), "input")
    click(browser, ".reset")


def pick_a_cell(browser):
    box = browser.run("(() => { window.scrollTo(0, 0); const b = document.querySelector('.stage canvas').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
    views = int(browser.run("document.querySelector('.stage').dataset.views"))
    near = (0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65)
    for x, y in sorted(((x, y) for x in near for y in near), key=lambda p: (p[0] - 0.5) ** 2 + (p[1] - 0.5) ** 2):
        mouse_click(browser, box[0] + box[2] / views * x, box[1] + y * box[3])
        if not browser.run("document.querySelector('.cell').hidden"):
            break
    else:
        raise AssertionError("no click finds a cell")
    wait_for(browser, "document.querySelectorAll('.cell td').length > 10 && document.querySelector('.cell canvas') != null")


def check_plots(browser):
    """No legend without curves or with a colour twice, at most five curves in it."""
    legends = browser.run("[...document.querySelectorAll('.curves')].map((l) => [...l.querySelectorAll('i')].map((i) => i.style.background))")
    for colours in legends:
        assert 1 <= len(colours) <= 5 and len(set(colours)) == len(colours), colours


def operate_rest(browser):
    for name in browser.run("[...(document.querySelector('#observable')?.options ?? [])].map((o) => o.value)")[:20]:
        browser.run(f"""(() => {{ const e = document.querySelector('#observable'); e.value = {json.dumps(name)}; e.dispatchEvent(new Event('change')); }})()""")
    browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    # Plots are drawn once they come near the window.
    for k in range(browser.run("document.querySelectorAll('.plot').length")):
        browser.run(f"document.querySelectorAll('.plot')[{k}].scrollIntoView()")
        wait_for(browser, f"document.querySelectorAll('.plot')[{k}].querySelector('canvas, img') != null", 15)
    check_plots(browser)
    wide = browser.run("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert wide <= 0, f"the page is {wide} px wider than the window"


def check_stages(browser):
    """A resumed run has its wall time per stage over all attempts and of the last; the last is not more."""
    text = browser.run("[...document.querySelectorAll('h3')].find((h) => h.textContent === 'Wall time per stage')?.parentElement.textContent ?? ''")
    assert "Sum over 2 attempts: the run was resumed once." in text and "last attempt" in text, text
    rows = browser.run("document.querySelectorAll('.bars.resumed > i').length")
    assert rows > 3 and browser.run("document.querySelectorAll('.bars.resumed > .amount').length") == 2 * rows + 2


def check_head(browser):
    """Mean contact pressures of both models in Pa, names in words."""
    head = browser.run("[...document.querySelectorAll('.tiles div')].map((d) => [d.querySelector('dt').textContent, d.querySelector('dd').textContent])")
    for model in ("deformable cells", "spheres"):
        [value] = [value for name, value in head if name == f"Mean contact pressure of {model}"]
        assert value.endswith(" Pa") and float(value.split()[0]) != 0, head
    assert any(name.startswith("Lesion radius, mean of the three inner rings") for name, _ in head), head
    assert not any("_" in name for name, _ in head), head


def try_page(browser, page, keep):
    name = os.path.splitext(os.path.basename(page))[0]
    browser.events.clear()
    browser.call("Emulation.setDeviceMetricsOverride", width=1400, height=1000, deviceScaleFactor=1, mobile=False)
    seconds = load(browser, page)
    if browser.run("document.querySelector('.stage') != null"):
        operate_fields(browser)
        operate_surface(browser)
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
    subprocess.run([acinus, "run", "lobule_hybrid", "--set", "start_up.growth_time=30 min", "--set", "output.every=10 min", "--until", "40 min",
                    "--threads", "1", "--out", run, "--quiet", "--resume"], check=True)
    other = os.path.join(folder, "other.run")
    subprocess.run([acinus, "run", "two_cells", "--until", "10 min", "--threads", "1", "--out", other, "--quiet"], check=True)
    starving = os.path.join(folder, "starving.run")
    subprocess.run([acinus, "run", "spheroid_oxygen", "--set", "cells.count=60", "--set", "output.every=10 min", "--until", "20 min", "--threads", "1",
                    "--out", starving, "--quiet"], check=True)
    pages = [os.path.join(folder, name) for name in ("one.html", "two.html", "fields.html")]
    subprocess.run([acinus, "report", run, "--out", pages[0], "--quiet"], check=True)
    subprocess.run([acinus, "report", run, other, "--out", pages[1], "--quiet"], check=True)
    subprocess.run([acinus, "report", starving, "--out", pages[2], "--quiet"], check=True)
    return pages


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("acinus")
    parser.add_argument("pages", nargs="*")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    program = find_browser()
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
                if not arguments.pages and page == pages[0]:
                    check_stages(browser)
                    check_head(browser)
        finally:
            browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
