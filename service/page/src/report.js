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

// The 3D view of one run, or of any two with a choice of which.
function view(shown) {
  const place = make("div", { class: "view" });
  let viewer = null;
  const show = (some) => {
    viewer?.end();
    const panel = new CellPanel(some);
    viewer = new Viewer(some, (run, id, frame, field) => panel.show(run, id, frame, field));
    place.replaceChildren(viewer.element, panel.element);
    return viewer.start().then(() => { window.acinusViewer = viewer; });
  };
  const choose = (start) => make("select", { "aria-label": start === 0 ? "Run on the left" : "Run on the right", onchange: () => show(selects.map((s) => shown[s.value])) },
    ...shown.map((r, k) => make("option", { value: k, selected: k === start }, r.name)));
  const selects = shown.length > MOST_VIEWS ? [choose(0), choose(1)] : [];
  section(null, selects.length > 0 ? make("div", { class: "row pair" }, "In 3D", selects[0], "beside", selects[1]) : null, place);
  return show(shown.slice(0, MOST_VIEWS));
}

async function build() {
  document.querySelector("footer").textContent = `acinus ${data.version}. This page is complete and loads nothing from elsewhere.`;
  if (runs.length === 1) section(null, header(runs[0]));
  if (runs.length > 1) section(`Comparison of ${runs.length} runs`, make("p", { class: "about" }, runs.map((r) => r.name).join(", ")));
  const shown = runs.filter((r) => r.frames.list.length > 0)
    .map((r) => ({ name: r.name, raw: r.frames, frames: openFrames(r.frames), scene: r.scene, walls: r.walls }));
  let drawn = Promise.resolve();
  if (shown.length > 0) drawn = view(shown).catch((fault) => section(null, make("p", { class: "warnings" }, `No 3D view: ${fault.message}`)));
  if (data.comparison) section("Differences", comparison(data.comparison, runs.map((r) => r.name)));
  if (runs.length > 0) section("Over time", curves(runs));
  runs.forEach((run) => section(runs.length === 1 ? "The run" : null, runs.length > 1 ? header(run) : null, overview(run), events(run)));
  for (const item of data.items) {
    if (item.type === "law") section(null, law(item));
    if (item.type === "study") section(null, study(item));
  }
  await drawn;
}

build().then(() => document.body.setAttribute("data-ready", "yes"),
  (fault) => { document.body.setAttribute("data-ready", "failed"); throw fault; });
