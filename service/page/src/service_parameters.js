// A form of all keys of the chosen scene. Only values that differ from the scene are sent.
import { rowsOf, sortFaults, textOf, valueOf } from "./parameters.js";
import { make } from "./text.js";

const PAUSE = 400; // ms after the last key before the scene is checked

export class ParametersPanel {
  // form: {read(): what it asks for, changes(): its changes, setChanges(set)}; preview(), start(): of the form
  constructor(element, form, { preview, start }) {
    this.element = element;
    this.form = form;
    this.schema = null;
    this.rows = [];
    this.turn = 0;
    this.search = make("input", { type: "search", placeholder: "Search: adhesion, time.end, Young ...", "aria-label": "Search parameters", oninput: () => this.filter() });
    this.only = make("input", { type: "checkbox", onchange: () => this.filter() });
    this.verdict = make("p", { class: "verdict", role: "status" });
    this.rest = make("pre", { role: "alert", hidden: true });
    this.groups = make("div", { class: "groups" });
    element.replaceChildren(make("section", {}, make("div", { class: "headline" }, make("h2", {}, "Parameters"), (this.scene = make("span", {}))),
      make("div", { class: "find" }, this.search, make("label", { class: "check" }, this.only, "changed only")), this.verdict, this.rest,
      make("div", { class: "actions" }, make("button", { type: "button", onclick: preview }, "Preview"), make("button", { type: "button", onclick: start }, "Start"),
        make("button", { type: "button", onclick: () => this.resetAll() }, "Reset all"))), make("section", {}, this.groups));
  }

  async open() {
    const turn = ++this.turn;
    delete this.element.dataset.ready;
    this.say("Reading the scene …");
    try {
      this.schema ??= await (await fetch("/schema")).json();
      const asked = await this.form.read();
      const answer = await fetch("/check", { method: "POST", body: JSON.stringify({ ...asked, set: {} }) });
      const scene = await answer.json();
      if (turn !== this.turn) return;
      if (!answer.ok) throw new Error(scene.error.message);
      this.scene.textContent = typeof asked.scene === "string" ? asked.scene : scene.name;
      this.rows = rowsOf(this.schema, scene);
      this.build();
      await this.check();
    } catch (error) {
      this.groups.replaceChildren();
      this.say("");
      this.tellRest(error.message);
    }
    this.element.dataset.ready = "yes";
  }

  say(text) { this.verdict.textContent = text; }

  tellRest(text) {
    this.rest.textContent = text;
    this.rest.hidden = !text;
  }

  build() {
    const groups = new Map();
    for (const row of this.rows) groups.set(row.group, [...(groups.get(row.group) ?? []), row]);
    this.groups.replaceChildren(...[...groups].map(([name, rows]) => {
      const count = make("span", { class: "quiet" });
      const block = make("details", {}, make("summary", {}, name, count), ...rows.map((r) => this.makeRow(r)));
      const absent = rows.every((r) => !r.inScene) ? ", not in this scene" : "";
      block.tell = (n) => { count.textContent = `${n < rows.length ? `${n} of ` : ""}${rows.length} ${rows.length === 1 ? "key" : "keys"}${absent}`; };
      for (const r of rows) r.block = block;
      return block;
    }));
    this.takeChanges();
    this.filter();
  }

  makeRow(row) {
    const id = `key-${row.path}`, about = `${id}-about`;
    const options = { id, "aria-describedby": about, onchange: () => this.edit(row), oninput: () => this.edit(row) };
    row.field = row.choices
      ? make("select", options, ...[...new Set([row.inScene ? textOf(row.value) : "", ...row.choices.map(textOf)])].map((c) => make("option", { value: c }, c === "" ? "–" : c)))
      : Array.isArray(row.value) || (row.value && typeof row.value === "object") ? make("textarea", { ...options, rows: Math.min(6, 1 + Math.floor(textOf(row.value).length / 40)), spellcheck: "false" })
        : make("input", { ...options, type: "text", spellcheck: "false", placeholder: row.fallback === undefined ? row.unit : textOf(row.fallback) });
    row.field.value = row.inScene ? textOf(row.value) : "";
    row.fault = make("p", { class: "fault", role: "alert", hidden: true });
    row.reset = make("button", { type: "button", class: "reset", hidden: true, "aria-label": `Reset ${row.path}`, onclick: () => { row.field.value = row.inScene ? textOf(row.value) : ""; this.edit(row); row.field.focus(); } }, "Reset");
    const limits = [row.unit ? `in ${row.unit}` : null, row.range ? `range ${row.range}` : null, row.paper ? `paper: ${row.paper}` : null].filter((p) => p).join("; ");
    row.element = make("div", { class: "parameter" }, make("label", { for: id }, make("code", {}, row.path)), make("div", { class: "value" }, row.field, row.reset), row.fault,
      make("p", { class: "meaning", id: about }, row.meaning, limits ? make("span", { class: "limits" }, limits) : null));
    row.words = `${row.path} ${row.meaning} ${row.paper} ${row.unit} ${row.dimension}`.toLowerCase();
    return row.element;
  }

  // Shows the changes of the form in their fields.
  takeChanges() {
    this.set = this.form.changes();
    for (const row of this.rows) if (row.path in this.set) row.field.value = textOf(this.set[row.path]);
    this.rows.forEach((row) => this.mark(row));
  }

  mark(row) {
    row.changed = row.path in this.set;
    row.element.classList.toggle("changed", row.changed);
    row.reset.hidden = !row.changed;
  }

  edit(row) {
    const text = row.field.value;
    if (text === (row.inScene ? textOf(row.value) : "")) delete this.set[row.path];
    else this.set[row.path] = valueOf(row, text);
    this.mark(row);
    this.form.setChanges(this.set);
    delete this.element.dataset.ready;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.check().then(() => { this.element.dataset.ready = "yes"; }), PAUSE);
  }

  resetAll() {
    this.form.setChanges({});
    this.open();
  }

  // The program's own messages stand beside the keys that they are about.
  async check() {
    const turn = ++this.turn;
    let message = "";
    try {
      const answer = await fetch("/check", { method: "POST", body: JSON.stringify(await this.form.read()) });
      if (!answer.ok) message = (await answer.json()).error.message;
    } catch (error) { message = error.message; }
    if (turn !== this.turn) return;
    const { faults, rest } = sortFaults(message, new Set(this.rows.map((r) => r.path)));
    for (const row of this.rows) {
      const texts = faults.get(row.path) ?? [];
      row.fault.textContent = texts.join("\n");
      row.fault.hidden = texts.length === 0;
      row.element.classList.toggle("wrong", texts.length > 0);
      row.field.setAttribute("aria-invalid", String(texts.length > 0));
      if (texts.length > 0) row.block.open = true;
    }
    this.tellRest(rest.join("\n"));
    const n = Object.keys(this.set).length, changed = n === 0 ? "No value differs from the scene." : n === 1 ? "One value differs from the scene." : `${n} values differ from the scene.`;
    this.say(`${changed} ${message ? "The scene cannot run so." : "The scene is valid."}`);
    this.filter();
  }

  filter() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter((w) => w), active = words.length > 0 || this.only.checked;
    const seen = new Map();
    for (const row of this.rows) {
      row.element.hidden = !(words.every((w) => row.words.includes(w)) && (!this.only.checked || row.changed));
      seen.set(row.block, (seen.get(row.block) ?? 0) + (row.element.hidden ? 0 : 1));
    }
    for (const [block, n] of seen) {
      block.hidden = n === 0;
      block.tell(n);
      if (active && n > 0) block.open = true;
    }
  }
}
