// Runs in three dimensions, side by side with one camera and one time.
import { PerspectiveCamera, Plane, Raycaster, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { availableFields, classColour, FIELDS, gradient, rangeOf } from "./colour.js";
import { Model } from "./model.js";
import { duration, make, number } from "./text.js";

const EVERYTHING = 1e9;

export class Viewer {
  // runs: [{name, frames: data.openFrames(..), raw: the frames' description}]; picked(run, id, frame, field)
  constructor(runs, picked) {
    this.runs = runs;
    this.picked = picked;
    this.times = [...new Set(runs.flatMap((r) => r.frames.times))].sort((a, b) => a - b);
    this.plane = new Plane(new Vector3(1, 0, 0), EVERYTHING);
    this.models = runs.map(() => new Model(this.plane));
    this.field = "model";
    this.canvas = make("canvas", { tabindex: "0", role: "img", "aria-label": "Cells in three dimensions. Arrow keys turn, plus and minus zoom." });
    this.stage = make("div", { class: "stage" }, this.canvas);
    this.element = make("div", { class: "viewer" }, this.stage, this.makeControls());
    if (runs.length > 1) for (const r of runs) this.stage.append(make("span", { class: "tag" }, r.name));
    this.stage.dataset.views = runs.length;
  }

  async start() {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.localClippingEnabled = true;
    this.renderer.setScissorTest(true);
    this.camera = new PerspectiveCamera(32, 1, 0.1, 1e6);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.addEventListener("change", () => this.draw());
    this.canvas.addEventListener("keydown", (e) => this.key(e));
    let down = null;
    this.canvas.addEventListener("pointerdown", (e) => { down = [e.clientX, e.clientY]; });
    this.canvas.addEventListener("pointerup", (e) => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 4) this.pickAt(e);
    });
    new ResizeObserver(() => this.resize()).observe(this.stage);
    await this.showTime(this.times.length - 1);
    this.reset();
  }

  makeControls() {
    const raw = this.runs[0].raw;
    this.slider = make("input", { type: "range", min: 0, max: this.times.length - 1, value: this.times.length - 1, "aria-label": "Frame", oninput: () => this.showTime(+this.slider.value) });
    this.clock = make("output", { class: "clock" });
    this.playButton = make("button", { type: "button", class: "play", "aria-label": "Play", onclick: () => this.play() }, "▶");
    const names = availableFields(raw).filter((f) => this.runs.every((r) => availableFields(r.raw).includes(f)));
    this.select = make("select", { id: "field", onchange: () => this.colourBy(this.select.value) }, ...names.map((n) => make("option", { value: n }, FIELDS[n].label)));
    this.legend = make("div", { class: "legend", "aria-live": "polite" });
    const toggle = (label, set) => make("label", { class: "check" }, make("input", { type: "checkbox", checked: true, onchange: (e) => { set(e.target.checked); this.draw(); } }), label);
    this.axis = make("select", { id: "cut", onchange: () => this.cut() }, ...["off", "x", "y", "z"].map((a) => make("option", { value: a }, a)));
    this.depth = make("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0.5, disabled: true, "aria-label": "Position of the cut", oninput: () => this.cut() });
    return make("div", { class: "controls" },
      make("div", { class: "row time" }, this.playButton, this.slider, this.clock),
      make("div", { class: "row" }, make("label", { for: "field" }, "Colour"), this.select, this.legend),
      make("div", { class: "row" },
        toggle("deformable", (on) => this.models.forEach((m) => { m.cells.visible = on; })),
        toggle("spheres", (on) => this.models.forEach((m) => { m.showSpheres = on; if (m.spheres) m.spheres.visible = on; })),
        toggle("vessels, walls", (on) => this.models.forEach((m) => { m.still.visible = on; }))),
      make("div", { class: "row" }, make("label", { for: "cut" }, "Cut"), this.axis, this.depth,
        make("button", { type: "button", class: "reset", onclick: () => this.reset() }, "Reset view")),
      make("p", { class: "hint" }, "Drag to turn, scroll to zoom, right-drag to move. Click a cell for its row and history."));
  }

  async showTime(k) {
    const wanted = (this.wanted = this.times[k]);
    const near = (times) => times.reduce((best, t, i) => (Math.abs(t - wanted) < Math.abs(times[best] - wanted) ? i : best), 0);
    const frames = await Promise.all(this.runs.map((r) => r.frames.frame(near(r.frames.times))));
    if (this.wanted !== wanted) return; // moved on meanwhile
    frames.forEach((f, i) => this.models[i].show(f));
    this.slider.value = k;
    this.clock.textContent = `${duration(wanted)} · frame ${frames[0].number}`;
    this.slider.setAttribute("aria-valuetext", duration(wanted));
    await this.paint();
    if (this.shown) this.picked(this.shown.run, this.shown.id, this.models[this.shown.run].frame, this.field);
  }

  async colourBy(field) {
    this.field = this.select.value = field;
    await this.paint();
    if (this.shown) this.picked(this.shown.run, this.shown.id, this.models[this.shown.run].frame, field);
  }

  async paint() {
    const field = FIELDS[this.field];
    if (!field.classes && this.ranged !== this.field) {
      const all = await Promise.all(this.runs.flatMap((r) => r.frames.times.map((_, k) => r.frames.frame(k))));
      this.range = rangeOf(this.field, all);
      this.ranged = this.field;
    }
    for (const m of this.models) m.paint(this.field, this.range ?? [0, 1]);
    if (field.classes) {
      const seen = this.field === "type" ? [...new Set(this.models.flatMap((m) => [...m.frame.table.type]))].sort() : field.classes.map((_, k) => k);
      this.legend.replaceChildren(...seen.map((k) => make("span", { class: "class" }, make("i", { style: `background:${classColour(k)}` }), field.classes[k] ?? `type ${k}`)));
    } else {
      this.legend.replaceChildren(make("span", {}, number(+this.range[0].toPrecision(3))), make("i", { class: "bar", style: `background:${gradient()}` }),
        make("span", {}, `${number(+this.range[1].toPrecision(3))} ${field.unit}`));
    }
    this.draw();
  }

  cut() {
    const axis = "xyz".indexOf(this.axis.value);
    this.depth.disabled = axis < 0;
    if (axis < 0) {
      this.plane.constant = EVERYTHING;
    } else {
      const low = this.low.getComponent(axis);
      const high = this.high.getComponent(axis);
      this.plane.normal.set(0, 0, 0).setComponent(axis, axis === 1 ? 1 : -1);
      const at = low + +this.depth.value * (high - low);
      this.plane.constant = axis === 1 ? -at : at;
    }
    this.draw();
  }

  // The whole of all runs, seen from the front and a little above.
  reset() {
    const boxes = this.models.map((m) => m.box());
    this.low = boxes.map((b) => b[0]).reduce((a, b) => a.clone().min(b));
    this.high = boxes.map((b) => b[1]).reduce((a, b) => a.clone().max(b));
    const centre = this.low.clone().add(this.high).multiplyScalar(0.5);
    const size = Math.max(1, this.low.distanceTo(this.high));
    this.fittedAspect = null;
    this.resize();
    this.fittedAspect = this.camera.aspect;
    const fit = 0.5 * size / Math.sin((Math.PI / 360) * this.camera.fov) / Math.min(1, this.camera.aspect);
    this.camera.position.copy(centre).add(new Vector3(0.45, -0.8, 0.55).normalize().multiplyScalar(0.74 * fit));
    this.camera.near = size / 200;
    this.camera.far = size * 50;
    this.camera.updateProjectionMatrix();
    this.orbit.target.copy(centre);
    this.orbit.update();
    this.cut();
  }

  resize() {
    if (!this.renderer) return;
    const { clientWidth: w, clientHeight: h } = this.stage;
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / this.runs.length / Math.max(1, h);
    // What fitted into the width at the last reset still does.
    this.camera.zoom = Math.min(1, this.camera.aspect / (this.fittedAspect ?? this.camera.aspect));
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (!this.renderer || !this.models[0].frame) return;
    const { clientWidth: w, clientHeight: h } = this.stage;
    const part = w / this.runs.length;
    this.models.forEach((m, k) => {
      this.renderer.setViewport(k * part, 0, part, h);
      this.renderer.setScissor(k * part, 0, part, h);
      m.light.position.copy(this.camera.position).sub(this.orbit.target).normalize().add(new Vector3(0.3, 0.2, 0.6));
      this.renderer.render(m.scene, this.camera);
    });
  }

  pickAt(e) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const part = width / this.runs.length;
    const run = Math.min(this.runs.length - 1, Math.floor((e.clientX - left) / part));
    const at = new Vector2((((e.clientX - left) - run * part) / part) * 2 - 1, 1 - ((e.clientY - top) / height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    this.mark(run, this.models[run].pick(ray, this.plane));
  }

  mark(run, id) {
    this.models.forEach((m, k) => { m.marked = k === run ? id : null; });
    this.shown = id == null ? null : { run, id };
    this.paint();
    this.picked(run, id, this.models[run].frame, this.field);
  }

  play() {
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = null;
    } else {
      if (+this.slider.value >= this.times.length - 1) this.showTime(0);
      this.playing = setInterval(() => {
        const next = +this.slider.value + 1;
        if (next >= this.times.length) this.play();
        else this.showTime(next);
      }, 160);
    }
    this.playButton.textContent = this.playing ? "❚❚" : "▶";
    this.playButton.setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }

  key(e) {
    const turn = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, -0.12], ArrowDown: [0, 0.12] }[e.key];
    const from = this.camera.position.clone().sub(this.orbit.target);
    if (turn) {
      from.applyAxisAngle(this.camera.up, turn[0]);
      from.applyAxisAngle(new Vector3().crossVectors(this.camera.up, from).normalize(), turn[1]);
    } else if (e.key === "+" || e.key === "-") {
      from.multiplyScalar(e.key === "+" ? 0.9 : 1.1);
    } else {
      return;
    }
    e.preventDefault();
    this.camera.position.copy(this.orbit.target).add(from);
    this.orbit.update();
  }
}
