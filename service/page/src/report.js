// The page: every item in its section.
import { CellPanel } from "./cell.js";
import { curves } from "./curves.js";
import { openFrames } from "./data.js";
import { comparison, law, study } from "./others.js";
import { events, header, overview } from "./overview.js";
import { make } from "./text.js";
import { Viewer } from "./viewer.js";

const MOST_VIEWS = 2;

const data = JSON.parse(document.getElementById("data").textContent);
const main = document.querySelector("main");
const runs = data.items.filter((item) => item.type === "run");

function section(title, ...content) {
  const used = content.filter((c) => c != null);
  if (used.length > 0) main.append(make("section", {}, title ? make("h2", {}, title) : null, ...used));
}

function view(shown) {
  const panel = new CellPanel(shown);
  const viewer = new Viewer(shown, (run, id, frame, field) => panel.show(run, id, frame, field));
  section(null, make("div", { class: "view" }, viewer.element, panel.element));
  return viewer.start().then(() => { window.acinusViewer = viewer; });
}

async function build() {
  document.querySelector("footer").textContent = `acinus ${data.version}. Lengths µm, times as written, forces nN. This page is complete: it loads nothing.`;
  for (const run of runs.slice(0, 1)) section(null, header(run));
  const shown = runs.filter((r) => r.frames.list.length > 0).slice(0, MOST_VIEWS)
    .map((r) => ({ name: r.name, raw: r.frames, frames: openFrames(r.frames) }));
  let drawn = Promise.resolve();
  if (shown.length > 0) drawn = view(shown).catch((fault) => section(null, make("p", { class: "warnings" }, `No 3D view: ${fault.message}`)));
  if (data.comparison) section("Comparison", comparison(data.comparison, runs.map((r) => r.name)));
  if (runs.length > 0) section("Over time", curves(runs));
  runs.forEach((run, k) => section(k === 0 ? "The run" : null, k > 0 ? header(run) : null, overview(run), events(run)));
  for (const item of data.items) {
    if (item.type === "law") section(null, law(item));
    if (item.type === "study") section(null, study(item));
  }
  await drawn;
}

build().then(() => document.body.setAttribute("data-ready", "yes"),
  (fault) => { document.body.setAttribute("data-ready", "failed"); throw fault; });
