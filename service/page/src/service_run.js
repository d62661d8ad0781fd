// The chosen run: how far it is, what it measures, what can be done with it.
import { inShownUnit, nameOf, shownIn } from "./names.js";
import { plot } from "./plots.js";
import { bytes, cellCounts, duration, make } from "./text.js";

const FIRST = ["lesion_area_relative", "lesion_area_flooded", "lesion_area", "cells", "radius_of_gyration_um", "mean_pressure_Pa", "contact_pressure_mean_dcm_Pa"];
const ENDED = ["completed", "stopped", "failed"];
const PLOTS = 2;
const REFRESH = 3000; // ms between updates of a run in progress

export class RunPanel {
  // clone(id): offers the scene and changes of a run for a new one
  constructor(element, clone) {
    this.element = element;
    this.clone = clone;
    this.run = null;
    setInterval(() => { if (this.run?.state === "running") this.drawSeries(); }, REFRESH);
  }

  // all: the runs of the list
  show(run, all) {
    this.others = all.filter((r) => r.id !== run?.id && ENDED.includes(r.state));
    const other = run?.id !== this.run?.id, news = JSON.stringify(run) !== JSON.stringify(this.run), ended = run?.state !== this.run?.state;
    this.run = run;
    if (other) this.build();
    const named = this.others.map((r) => r.id + r.name).join();
    if (run && (other || news || named !== this.named)) this.tell();
    this.named = named;
    if (run && (other || ended)) { this.drawSeries(); this.listFiles(); }
  }

  build() {
    this.chosen = null;
    if (!this.run) return this.element.replaceChildren(make("p", { class: "hint" }, "Choose a run, or start one."));
    this.head = make("div", { class: "headline" });
    this.facts = make("dl", { class: "facts" });
    this.actions = make("div", { class: "actions" });
    this.fault = make("pre", { role: "alert", hidden: true });
    this.plots = make("div", { class: "plots" });
    this.pick = make("div", { class: "pick" });
    this.files = make("ul", { class: "files" });
    this.view = make("div", { class: "report" });
    this.element.replaceChildren(make("section", {}, this.head, this.facts, this.actions, this.fault), make("section", {}, this.pick, this.plots),
      make("section", {}, make("h3", {}, "Files"), this.files), make("section", {}, this.view));
  }

  tell() {
    const run = this.run;
    this.head.replaceChildren(make("h2", {}, run.name), make("span", { class: "badge " + run.state }, run.state));
    const time = duration(Math.max(0, run.time_s));  // before: start-up
    const rows = [["simulated time", run.end_s > 0 ? `${time} of ${duration(run.end_s)}` : time], ["cells", cellCounts(run.cells)],
      ["scene", run.scene || "own"], ["changes", run.set.join(", ") || "none"], ["submitted", run.created]];
    if (run.phase && run.phase !== "running") rows.unshift(["phase", run.phase]);
    if (run.left_s != null) rows.push(["remaining wall time", `about ${duration(run.left_s)}`]);
    if (run.cause) rows.push(["cause", run.cause]);
    this.facts.replaceChildren(...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
    const focused = this.actions.contains(document.activeElement) ? document.activeElement.textContent : null;
    this.actions.replaceChildren(...this.possible());
    if (focused) [...this.actions.children].find((b) => b.textContent === focused)?.focus();
  }

  possible() {
    const { state, id } = this.run, button = (text, act) => make("button", { type: "button", onclick: act }, text);
    const all = [];
    if (state === "waiting" || state === "running") all.push(button("Stop", () => this.ask("POST", "/stop")));
    if (state === "stopped") all.push(button("Resume", () => this.ask("POST", "/resume")));
    if (state !== "waiting") all.push(button("Show in 3D", () => this.showReport()), make("a", { href: `/runs/${id}/report`, target: "_blank", rel: "noopener" }, "Open report"));
    if (this.run.scene) all.push(button("Clone", () => this.clone(id)));
    if (ENDED.includes(state) && this.others.length > 0) all.push(this.comparison());
    if (state !== "running") all.push(button("Delete", () => { if (confirm(`Delete ${this.run.name} and all its files?`)) this.ask("DELETE", ""); }));
    return all;
  }

  // A choice of another run to compare with; it is kept while the actions are renewed.
  comparison() {
    const other = make("select", { "aria-label": "Run to compare with", onchange: () => { this.other = other.value; } },
      ...this.others.map((r) => make("option", { value: r.id, selected: r.id === this.other }, r.name)));
    return make("span", { class: "with" }, make("button", { type: "button", onclick: () => { location.hash = `compare/${this.run.id}/${other.value}`; } }, "Compare with"), other);
  }

  async ask(method, what) {
    const answer = await fetch(`/runs/${this.run.id}${what}`, { method });
    this.fault.hidden = answer.ok;
    if (!answer.ok) this.fault.textContent = (await answer.json()).error.message;
  }

  // Its page stands in a frame of its own, which reaches nothing else.
  showReport() {
    const frame = make("iframe", { src: `/runs/${this.run.id}/report`, title: "Report of the run", sandbox: "allow-scripts allow-downloads" });
    this.view.replaceChildren(frame);
    frame.scrollIntoView({ behavior: "smooth" });
  }

  async listFiles() {
    const { id } = this.run;
    const answer = await fetch(`/runs/${id}/files`);
    if (!answer.ok || id !== this.run?.id) return;
    this.files.replaceChildren(...(await answer.json()).map((f) => make("li", {}, make("a", { href: `/runs/${id}/files/${f.name}`, download: true }, f.name), make("span", { class: "unit" }, ` ${bytes(f.bytes)}`))));
  }

  async drawSeries() {
    const { id, state } = this.run;
    if (state === "waiting") return;
    const answer = await fetch(`/runs/${id}/series`);
    if (!answer.ok || id !== this.run?.id) return;
    const series = await answer.json();
    const names = Object.keys(series).filter((n) => series[n].value.length > 0);
    if (names.length === 0) return;
    if (!this.chosen) {
      const first = [...FIRST.filter((n) => names.includes(n)), ...names.filter((n) => !FIRST.includes(n))];
      this.chosen = first.slice(0, PLOTS);
      this.pick.replaceChildren(...this.chosen.map((name, k) => make("select", { "aria-label": `Plot ${k + 1}`, onchange: (e) => { this.chosen[k] = e.target.value; this.drawSeries(); } },
        ...names.map((n) => make("option", { value: n, selected: n === name }, nameOf(n))))));
    }
    this.plots.replaceChildren(...this.chosen.map((n) => plot(nameOf(n), shownIn(series[n].unit)[1], [inShownUnit({ label: nameOf(n), time: series[n].time_s, value: series[n].value, unit: series[n].unit })])).filter((p) => p));
  }
}
