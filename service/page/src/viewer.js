// Runs in three dimensions, side by side with one camera and one time.
import { PerspectiveCamera, Plane, Raycaster, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { availableFields, classColour, FIELDS, gradient, rangeOf, SELECTED, valueOf } from "./colour.js";
import { Model, OBSTACLE_COLOUR } from "./model.js";
import { extremesOf, labelOf } from "./slice.js";
import { duration, make, nice, number } from "./text.js";
import { WALL_COLOUR } from "./walls.js";

const EVERYTHING = 1e9;
const VIEW_ANGLE = 32; // degrees
const FROM = new Vector3(0.45, -0.8, 0.55).normalize(); // the front, a little above
const FROM_SLICE = [[1, -0.3, 0.3], [0.3, -1, 0.3], [0.15, -0.4, 1]].map((v) => new Vector3(...v).normalize()); // by axis
const ROOM = 1.05; // between what is drawn and the edges of the picture
const SCALE_BAR = 120; // px at most

const css = (colour) => `#${colour.toString(16).padStart(6, "0")}`;
const swatch = (colour, name) => make("span", { class: "class" }, make("i", { style: `background:${colour}` }), name);

// Kinds of obstacles that a run file draws as triangles.
function obstaclesOf({ scene }) {
  const names = [];
  if (scene?.lobule || scene?.vessels?.file) names.push("vessels");
  if (scene?.pipette) names.push("pipette");
  if (scene?.static_meshes?.length > 0) names.push("rigid meshes");
  return names;
}

export class Viewer {
  // runs: [{name, frames: data.openFrames(..), raw: the frames' description, scene, walls}]; picked(run, id, frame, field)
  constructor(runs, picked) {
    this.runs = runs;
    this.picked = picked;
    this.times = [...new Set(runs.flatMap((r) => r.frames.times))].sort((a, b) => a - b);
    this.plane = new Plane(new Vector3(1, 0, 0), EVERYTHING);
    this.models = runs.map((r) => new Model(this.plane, r.walls ?? [], r.raw.grid));
    this.field = this.bothModels() ? "model" : "cell";
    this.canvas = make("canvas", { tabindex: "0", role: "img", "aria-label": "Cells in three dimensions. Arrow keys turn, plus and minus zoom." });
    this.scale = make("div", { class: "scale", title: "in the middle of what is shown" }, make("i", {}), make("span", {}));
    this.stage = make("div", { class: "stage" }, this.canvas, this.scale);
    this.element = make("div", { class: "viewer" }, this.stage, this.makeControls());
    this.tags = runs.length > 1 ? runs.map((r) => make("span", { class: "tag" }, r.name)) : [];
    this.stage.append(...this.tags);
    this.stage.dataset.views = runs.length;
  }

  async start() {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.localClippingEnabled = true;
    this.renderer.setScissorTest(true);
    this.camera = new PerspectiveCamera(VIEW_ANGLE, 1, 0.1, 1e6);
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
    // The last frame in which the cells are near each other: cells pulled apart would be dots.
    let k = this.times.length - 1;
    await this.showTime(k);
    while (k > 0 && !this.models.some((m) => m.isCompact())) await this.showTime(--k);
    if (!this.models.some((m) => m.isCompact())) await this.showTime(this.times.length - 1);
    await this.reset();
  }

  // Releases the drawing context; browsers have few.
  end() {
    if (this.playing) this.play();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
    this.renderer = null;
  }

  hasSpheres() { return this.runs.some((r) => r.raw.list.some((f) => f.spheres > 0)); }
  hasMeshes() { return this.runs.some((r) => r.raw.meshes.some((m) => m.triangles > 0)); }
  bothModels() { return this.hasSpheres() && this.hasMeshes(); }

  // Switches for what there is, and only if there is more than one kind.
  makeSwitches() {
    const obstacles = [...new Set(this.runs.flatMap(obstaclesOf))];
    const still = this.runs.some((r) => r.raw.still.some((s) => s.triangles > 0));
    const walls = this.runs.some((r) => r.walls?.length > 0);
    this.obstacles = [...(still ? [swatch(css(OBSTACLE_COLOUR), obstacles.join(", ") || "obstacles")] : []),
      ...(walls ? [swatch(css(WALL_COLOUR), this.runs.every((r) => (r.walls ?? []).every((w) => w.mirror)) ? "mirror planes" : "walls")] : [])];
    const set = (change) => (on) => this.models.forEach((m) => change(m, on));
    const kinds = [
      [this.hasMeshes(), "deformable cells", set((m, on) => { m.cells.visible = on; })],
      [this.hasSpheres(), "spheres", set((m, on) => { m.showSpheres = on; if (m.spheres) m.spheres.visible = on; })],
      [still, obstacles.join(", ") || "obstacles", set((m, on) => { m.still.visible = on; })],
      [walls, "walls", set((m, on) => { if (m.drawnWalls) m.drawnWalls.visible = on; })],
    ].filter(([has]) => has);
    if (kinds.length < 2) return null;
    return make("div", { class: "row" }, make("span", { class: "quiet" }, "Show"), ...kinds.map(([, label, change]) => make("label", { class: "check" },
      make("input", { type: "checkbox", checked: true, onchange: (e) => { change(e.target.checked); this.cut(); } }), label)));
  }

  makeControls() {
    const raw = this.runs[0].raw;
    this.slider = make("input", { type: "range", min: 0, max: this.times.length - 1, value: this.times.length - 1, "aria-label": "Frame", oninput: () => this.showTime(+this.slider.value) });
    this.clock = make("output", { class: "clock" });
    this.playButton = make("button", { type: "button", class: "play", "aria-label": "Play", onclick: () => this.play() }, "▶");
    const names = availableFields(raw).filter((f) => this.runs.every((r) => availableFields(r.raw).includes(f)));
    this.select = make("select", { id: "field", onchange: () => this.colourBy(this.select.value) }, ...names.map((n) => make("option", { value: n, selected: n === this.field }, FIELDS[n].label)));
    if (!names.includes(this.field)) this.field = names[0] ?? "model";
    this.legend = make("div", { class: "legend", "aria-live": "polite" });
    this.axis = make("select", { id: "cut", onchange: () => (this.slice?.value && this.isCut() ? this.reset() : this.cut()) }, ...["off", "x", "y", "z"].map((a) => make("option", { value: a }, a === "off" ? "off" : `across ${a}`)));
    this.depth = make("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0.5, disabled: true, "aria-label": "Position of the cut", oninput: () => this.cut() });
    return make("div", { class: "controls" },
      make("div", { class: "row time" }, this.playButton, this.slider, this.clock),
      make("div", { class: "row" }, make("label", { for: "field" }, "Colour by"), this.select, this.legend),
      this.makeSwitches(),
      this.makeFieldChoice(),
      this.makeSurfaceChoice(),
      make("div", { class: "row" }, make("label", { for: "cut" }, "Cut"), this.axis, this.depth,
        make("button", { type: "button", class: "reset", onclick: () => this.reset() }, "Reset view")),
      make("p", { class: "hint" }, "Drag to turn, scroll to zoom, right-drag to move. Click a cell for its values and history."));
  }

  // A choice of the field that the cut shows; null without substances.
  makeFieldChoice() {
    const unit = Object.fromEntries(this.runs.flatMap(({ raw }) => (raw.grid?.names ?? []).map((name, k) => [name, raw.grid.units[k]])));
    this.unitOfSlice = unit;
    if (Object.keys(unit).length === 0) return null;
    this.slice = make("select", { id: "slice", onchange: () => this.sliceBy(this.slice.value) }, make("option", { value: "" }, "none"),
      ...Object.keys(unit).map((name) => make("option", { value: name }, labelOf(name))));
    this.sliceLegend = make("div", { class: "legend", "aria-live": "polite" });
    return make("div", { class: "row" }, make("label", { for: "slice" }, "Slice of"), this.slice, this.sliceLegend);
  }

  // A choice of the field of which a surface is shown, and its level; null without substances.
  makeSurfaceChoice() {
    if (!this.slice) return null;
    this.surface = make("select", { id: "surface", onchange: () => this.surfaceOf(this.surface.value) }, ...[...this.slice.options].map((o) => make("option", { value: o.value }, o.textContent)));
    this.level = make("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0.5, disabled: true, "aria-label": "Level of the surface", oninput: () => { this.placeSurfaces(); this.draw(); } });
    this.levelText = make("output", {});
    return make("div", { class: "row" }, make("label", { for: "surface" }, "Iso-surface of"), this.surface, this.level, this.levelText);
  }

  // Shows the surface on which a field has the level of the slider, from its smallest to its largest value in all frames.
  async surfaceOf(name) {
    if (name) this.surfaceRange = extremesOf(name, await this.allFrames());
    if (this.surface.value !== name) return; // another one was chosen meanwhile
    this.level.disabled = !name;
    this.placeSurfaces();
    await this.reset();
  }

  placeSurfaces() {
    if (!this.surface) return;
    const name = this.surface.value, [low, high] = this.surfaceRange ?? [0, 1];
    const level = low + +this.level.value * (high - low);
    this.levelText.textContent = name ? `at ${number(+level.toPrecision(3))} ${nice(this.unitOfSlice[name])}` : "";
    this.level.setAttribute("aria-valuetext", this.levelText.textContent);
    for (const m of this.models) m.surface.show(m.frame, name, level, [low, high]);
  }

  // Shows a field of a substance in the plane of the cut, which begins in the middle across y.
  async sliceBy(name) {
    if (name && !this.isCut()) this.axis.value = "y";
    if (name) this.sliceRange = extremesOf(name, await this.allFrames());
    if (this.slice.value !== name) return; // another one was chosen meanwhile
    this.sliceLegend.replaceChildren(...(name ? this.barOf(this.sliceRange, nice(this.unitOfSlice[name])) : []));
    this.placeSlices();
    await this.reset();
  }

  placeSlices() {
    if (!this.slice) return;
    const axis = "xyz".indexOf(this.axis.value), at = axis < 0 ? 0 : this.plane.coplanarPoint(new Vector3()).getComponent(axis);
    const name = this.slice.value;
    const avoidsCells = (scene) => scene?.substances?.some((s) => s.name === name && s.cells === "keep_out");
    this.models.forEach((m, k) => m.showSlice(name, axis, at, this.sliceRange, avoidsCells(this.runs[k].scene)));
  }

  allFrames() { return Promise.all(this.runs.flatMap((r) => r.frames.times.map((_, k) => r.frames.frame(k)))); }

  async showTime(k) {
    const wanted = (this.wanted = this.times[k]);
    const near = (times) => times.reduce((best, t, i) => (Math.abs(t - wanted) < Math.abs(times[best] - wanted) ? i : best), 0);
    const frames = await Promise.all(this.runs.map((r) => r.frames.frame(near(r.frames.times))));
    if (this.wanted !== wanted) return; // moved on meanwhile
    frames.forEach((f, i) => { this.models[i].show(f); this.models[i].cut(this.isCut()); });
    this.placeSlices();
    this.placeSurfaces();
    this.tags.forEach((tag, i) => { tag.textContent = this.runs[i].name + (this.models[i].isCompact() ? "" : ": cells far apart at this time"); });
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
    if (!field.classes && !field.each && this.ranged !== this.field) {
      this.range = rangeOf(this.field, await this.allFrames());
      this.ranged = this.field;
    }
    for (const m of this.models) m.paint(this.field, this.range ?? [0, 1]);
    this.legend.replaceChildren(...this.legendOf(field), ...this.obstacles, ...(this.shown ? [swatch(`rgb(${SELECTED})`, "selected cell")] : []));
    this.draw();
  }

  legendOf(field) {
    if (field.each) return [make("span", {}, "one colour per cell")];
    if (field.classes) {
      const seen = [...new Set(this.models.flatMap((m) => [...m.frame.row.values()].map((at) => valueOf(this.field, m.frame.table, at))))].sort();
      return seen.map((k) => swatch(classColour(k), field.classes[k] ?? `type ${k}`));
    }
    return this.barOf(this.range, field.unit);
  }

  barOf([low, high], unit) {
    return [make("span", {}, number(+low.toPrecision(3))), make("i", { class: "bar", style: `background:${gradient()}` }), make("span", {}, `${number(+high.toPrecision(3))} ${unit}`)];
  }

  isCut() { return this.axis.value !== "off"; }

  // Moves the plane and renews the section faces.
  cut() {
    const axis = "xyz".indexOf(this.axis.value);
    this.depth.disabled = axis < 0;
    if (axis < 0) {
      this.plane.constant = EVERYTHING;
      if (this.slice?.value) this.sliceBy((this.slice.value = ""));
    } else {
      const low = this.low.getComponent(axis);
      const high = this.high.getComponent(axis);
      this.plane.normal.set(0, 0, 0).setComponent(axis, axis === 1 ? 1 : -1);
      const at = low + +this.depth.value * (high - low);
      this.plane.constant = axis === 1 ? -at : at;
    }
    for (const m of this.models) m.cut(this.isCut());
    this.placeSlices();
    return this.paint();
  }

  // Everything drawn of all runs, as large as fits, from the front and a little above.
  reset() {
    const near = this.models.filter((m) => m.isCompact());
    const fitted = near.length > 0 ? near : this.models;
    const boxes = fitted.map((m) => m.fullBox());
    this.low = boxes.map((b) => b[0]).reduce((a, b) => a.clone().min(b));
    this.high = boxes.map((b) => b[1]).reduce((a, b) => a.clone().max(b));
    this.fittedAspect = null;
    this.resize();
    this.fittedAspect = this.camera.aspect;
    const from = this.slice?.value ? FROM_SLICE["xyz".indexOf(this.axis.value)] : FROM;
    this.fit(fitted, from, this.low.clone().add(this.high).multiplyScalar(0.5));
    return this.cut();
  }

  // Places the camera so that no point leaves the picture. Right, left, top and bottom are planes through the eye, so
  // the nearest eye from which all points are inside follows from the largest offset to each.
  fit(models, from, middle) {
    const right = new Vector3().crossVectors(this.camera.up, from).normalize(), up = new Vector3().crossVectors(from, right);
    const high = Math.tan((Math.PI / 360) * VIEW_ANGLE) / ROOM, wide = high * this.camera.aspect;
    const most = { right: -Infinity, left: -Infinity, top: -Infinity, bottom: -Infinity };
    const p = new Vector3();
    for (const m of models)
      m.forEachDrawn((x, y, z, r) => {
        p.set(x, y, z).sub(middle);
        const [across, above, near] = [p.dot(right), p.dot(up), p.dot(from)];
        const h = near * wide + r * Math.hypot(1, wide), v = near * high + r * Math.hypot(1, high);
        most.right = Math.max(most.right, h + across);
        most.left = Math.max(most.left, h - across);
        most.top = Math.max(most.top, v + above);
        most.bottom = Math.max(most.bottom, v - above);
      });
    if (!Number.isFinite(most.right)) return;
    const distance = Math.max((most.right + most.left) / (2 * wide), (most.top + most.bottom) / (2 * high), 1e-3);
    middle.addScaledVector(right, (most.right - most.left) / 2).addScaledVector(up, (most.top - most.bottom) / 2);
    this.camera.position.copy(middle).addScaledVector(from, distance);
    this.orbit.target.copy(middle);
    this.orbit.update();
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

  // Depth range as tight as the tissue allows, so that section faces and surfaces stay apart.
  setDepthRange() {
    const middle = this.low.clone().add(this.high).multiplyScalar(0.5);
    let reach = this.low.distanceTo(this.high) + 1;
    for (const m of this.models) m.forEachFieldCorner((x, y, z) => { reach = Math.max(reach, middle.distanceTo(new Vector3(x, y, z))); });
    const distance = this.camera.position.distanceTo(middle);
    this.camera.near = Math.max(distance - reach, reach / 500);
    this.camera.far = distance + reach;
    this.camera.updateProjectionMatrix();
  }

  draw() {
    if (!this.renderer || !this.models[0].frame || !this.low) return;
    const { clientWidth: w, clientHeight: h } = this.stage;
    const part = w / this.runs.length;
    this.setDepthRange();
    this.models.forEach((m, k) => {
      this.renderer.setViewport(k * part, 0, part, h);
      this.renderer.setScissor(k * part, 0, part, h);
      m.light.position.copy(this.camera.position).sub(this.orbit.target).normalize().add(new Vector3(0.3, 0.2, 0.6));
      this.renderer.render(m.scene, this.camera);
    });
    this.showScale(h);
  }

  showScale(height) {
    const distance = this.camera.position.distanceTo(this.orbit.target);
    const um = (2 * distance * Math.tan((Math.PI / 360) * VIEW_ANGLE)) / (height * this.camera.zoom); // per px
    const ten = 10 ** Math.floor(Math.log10(SCALE_BAR * um));
    const length = [5, 2, 1].find((f) => f * ten <= SCALE_BAR * um) * ten;
    this.scale.firstChild.style.width = `${length / um}px`;
    this.scale.lastChild.textContent = `${number(length)} µm`;
  }

  pickAt(e) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const part = width / this.runs.length;
    const run = Math.min(this.runs.length - 1, Math.floor((e.clientX - left) / part));
    const at = new Vector2((((e.clientX - left) - run * part) / part) * 2 - 1, 1 - ((e.clientY - top) / height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    this.mark(run, this.models[run].pick(ray));
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
