// The plots of one run, or of several over each other.
import { plot, runColour } from "./plots.js";
import { make } from "./text.js";

// What an experiment is about, first what it is named after.
const FIRST = [/^lesion_radius/, /^open_area/, /^front/, /^radius_of_gyration/, /_strain$/, /^force/, /^length/, /^suction/, /^gap/, /^position/, /height/, /sphericity/, /pressure_mean/];

const several = (runs) => runs.length > 1;

function fromSeries(runs, columns, change = (c) => c) {
  return runs.flatMap((run, k) => columns.filter(([name]) => run.series[name]).map(([name, label], c) => ({
    ...change(run.series[name]), label: several(runs) ? `${run.name}: ${label}` : label,
    colour: several(runs) ? runColour(k) : undefined, dash: several(runs) && c > 0 ? [6, 4] : undefined })));
}

const moves = (curve) => curve && new Set(curve.value).size > 1;
const varies = (curve) => curve && curve.value.some((v) => v !== 0 && v != null);

function band(runs, name, title, unit, scale) {
  const curves = [];
  const bands = [];
  runs.forEach((run, k) => {
    const b = run.bands[name];
    if (!b?.time) return;
    const colour = runColour(k);
    const at = curves.length;
    const of = (q) => b[q].map((v) => (v == null ? null : v * scale));
    const who = several(runs) ? `${run.name}: ` : "";
    curves.push({ label: `${who}95 %`, time: b.time, value: of("q95"), colour: `${colour}55`, width: 1 }, { label: "75 %", time: b.time, value: of("q75"), colour: `${colour}88`, width: 1 },
      { label: `${who}median`, time: b.time, value: of("q50"), colour, width: 2.2 }, { label: "25 %", time: b.time, value: of("q25"), colour: `${colour}88`, width: 1 }, { label: "5 %", time: b.time, value: of("q05"), colour: `${colour}55`, width: 1 });
    bands.push([at, at + 4, `${colour}1c`], [at + 1, at + 3, `${colour}2a`]);
  });
  return plot(title, unit, curves, { bands });
}

// "lesion_area_open_um2" without the unit that stands beside it
const titleOf = (name) => name.replace(/_(um2?|um3|nN|Pa|kPa|s|um_per_h)$/, "").replaceAll("_", " ");

function observable(runs, name) {
  const curves = runs.map((run, k) => ({ ...(run.observables[name] ?? {}), label: several(runs) ? run.name : name, colour: runColour(k) }));
  return plot(titleOf(name), runs.find((r) => r.observables[name])?.observables[name].unit ?? "", curves);
}

// Areas of a lesion, and how they are drawn: the first is what "closed" means.
const LESION_AREAS = [["lesion_area_relative", "nearest cell of each slice (closed: below 0.05)", undefined],
  ["lesion_area_rings_centre_floor", "nearest cell of each ring", [7, 4]],
  ["lesion_area_flooded", "open to the central vein", [2, 3]]];

function lesion(runs) {
  const curves = LESION_AREAS.flatMap(([name, label, dash]) => runs.flatMap((run, k) => run.observables[name] ? [{
    ...run.observables[name], label: several(runs) ? `${run.name}: ${label}` : label, colour: runColour(k), dash }] : []));
  return plot("Lesion area over that at the start", "", curves);
}

// Plots of whatever the experiment measures: the telling ones, and one to choose.
function measured(runs) {
  const names = [...new Set(runs.flatMap((r) => Object.keys(r.observables)))].filter((n) => runs.some((r) => varies(r.observables[n])));
  if (names.length === 0) return [];
  const told = FIRST.map((pattern) => names.find((n) => pattern.test(n))).filter((n, k, all) => n && all.indexOf(n) === k).slice(0, 3);
  const slot = make("div");
  const select = make("select", { id: "observable", "aria-label": "Quantity to plot", onchange: () => slot.replaceChildren(observable(runs, select.value)) }, ...names.map((n) => make("option", { value: n }, n)));
  select.value = names.find((n) => !told.includes(n) && runs.some((r) => moves(r.observables[n]))) ?? names[0];
  slot.append(observable(runs, select.value));
  return [...told.map((n) => observable(runs, n)), make("div", { class: "choose" }, make("label", { for: "observable" }, "Also measured: "), select, slot)];
}

function overlaps(runs) {
  const names = [...new Set(runs.flatMap((r) => Object.keys(r.observables)))].filter((n) => n.startsWith("overlap_") && runs.some((r) => varies(r.observables[n])));
  return plot("Overlaps", "um", runs.flatMap((run) => names.filter((n) => run.observables[n]).map((n) => ({ ...run.observables[n], label: (several(runs) ? `${run.name}: ` : "") + n.replace(/^overlap_|_um$/g, "").replaceAll("_", " ") }))));
}

function interfaceForces(runs) {
  const of = (name, label) => runs.filter((r) => r.interface.time).map((r, k) => ({ time: r.interface.time, value: r.interface[name], label: several(runs) ? `${r.name}: ${label}` : label, dash: name === "largest force" ? [6, 4] : undefined, colour: several(runs) ? runColour(k) : undefined }));
  return [plot("Forces between deformable cells and spheres", "nN", [...of("mean force", "mean"), ...of("largest force", "largest")]),
    plot("Pairs of a deformable cell and a sphere in contact", "", of("pairs", "pairs"))];
}

// Iterations of each step from their running sum; thinned samples are several steps apart.
const differences = (c) => ({ time: c.time.slice(1), value: c.value.slice(1).map((v, k) => v - c.value[k]) });

export function curves(runs) {
  const plots = [
    lesion(runs),
    ...measured(runs),
    plot("Cells", "", fromSeries(runs, [["dcm_cells", "deformable"], ["cbm_cells", "spheres"], ["asleep", "asleep"]].filter(([n]) => runs.some((r) => varies(r.series[n]))))),
    band(runs, "pressure", "Contact pressure of the cells, 5 to 95 %", "Pa", 1000),
    band(runs, "volume", "Volume over reference, 5 to 95 %", "", 1),
    overlaps(runs),
    ...interfaceForces(runs),
    plot("Length of a step", "s", fromSeries(runs, [["dt", "step"]]), { log: true }),
    plot("Error of a step, farthest move", "um", fromSeries(runs, [["error", "error"], ["max_move", "move"]])),
    plot("Iterations of the solver between samples", "", fromSeries(runs, [["cg_iterations", "iterations"]], differences)),
    plot("Rejected attempts", "", fromSeries(runs, [["rejections", "rejected"]].filter(([n]) => runs.some((r) => varies(r.series[n]))))),
  ];
  return make("div", { class: "plots" }, ...plots.filter((p) => p));
}
