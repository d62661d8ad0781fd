// The plots of one run, or of several over each other.
import { inShownUnit, nameOf, shownIn } from "./names.js";
import { MOST_CURVES, plot, runColour } from "./plots.js";
import { make } from "./text.js";

// What an experiment is about, first what it is named after.
export const FIRST = [/^lesion_radius_rings_centre/, /^lesion_area_relative/, /^front_radius/, /^radius_of_gyration/, /_strain$/, /^force/, /^length/, /^suction/, /^gap/, /^position/, /^pull_force_nN/, /height/, /sphericity/, /pressure_mean/];
const MOST_FIRST = 4;

const several = (runs) => runs.length > 1;
const named = (runs, run, label) => (several(runs) ? (label ? `${run.name}: ${label}` : run.name) : label);
const moves = (curve) => curve && new Set(curve.value).size > 1;
const varies = (curve) => curve && curve.value.some((v) => v !== 0 && v != null);

// columns: [[name in the series, label]], those left out that are 0 throughout or, with `moving`, constant in every run
function fromSeries(runs, columns, { change = (c) => c, moving = false } = {}) {
  const wanted = columns.filter(([name]) => runs.some((r) => (moving ? moves : varies)(r.series[name])));
  return runs.flatMap((run) => wanted.filter(([name]) => run.series[name]).map(([name, label]) => ({ ...change(run.series[name]), label: named(runs, run, label), ofRun: several(runs) })));
}

// Median of the cells, within the bands of half of them and of 90 %.
function band(runs, name, title, unit, scale) {
  const curves = [];
  const bands = [];
  runs.forEach((run, k) => {
    const b = run.bands[name];
    if (!b?.time) return;
    const colour = runColour(k), at = curves.length;
    const of = (q) => ({ time: b.time, value: b[q].map((v) => (v == null ? null : v * scale)), colour: `${colour}33`, width: 0.5 });
    curves.push(of("q95"), of("q75"), { ...of("q50"), label: named(runs, run, "median"), ofRun: several(runs), colour, width: 2 }, of("q25"), of("q05"));
    bands.push([at, at + 4, `${colour}1c`], [at + 1, at + 3, `${colour}2a`]);
  });
  return curves.some((c) => varies(c)) ? plot(title, unit, curves, { bands }) : null;
}

function observable(runs, name) {
  const curves = runs.filter((r) => r.observables[name]).map((run) => ({ ...inShownUnit(run.observables[name]), label: several(runs) ? run.name : nameOf(name), ofRun: several(runs) }));
  return plot(nameOf(name), shownIn(runs.find((r) => r.observables[name])?.observables[name].unit)[1], curves);
}

// Of a hybrid the mean contact pressures of both models in one plot.
const PRESSURES = [["contact_pressure_mean_dcm_Pa", "deformable cells"], ["contact_pressure_mean_cbm_Pa", "spheres"]];

function mainPlot(runs, name) {
  const both = PRESSURES.filter(([n]) => varies(runs[0].observables[n]));
  if (several(runs) || both.length < 2 || !both.some(([n]) => n === name)) return observable(runs, name);
  return plot("Mean contact pressure", "Pa", both.map(([n, label]) => ({ ...inShownUnit(runs[0].observables[n]), label })));
}

// Definitions of the lesion's area in one plot; the first is the one that "closed" refers to.
const LESION_AREAS = [["lesion_area_relative", "nearest cell of each slice (closed: below 0.05)"], ["lesion_area_rings_centre_floor", "nearest cell of each ring"],
  ["lesion_area_flooded", "open to the central vein"]];

function lesion(runs) {
  const areas = several(runs) ? LESION_AREAS.slice(0, 1) : LESION_AREAS;
  return plot("Lesion area over that at the start", "", areas.flatMap(([name, label]) => runs.filter((r) => r.observables[name]).map((run) => ({
    ...run.observables[name], label: several(runs) ? run.name : label, ofRun: several(runs) }))));
}

const namesOf = (runs) => [...new Set(runs.flatMap((r) => Object.keys(r.observables)))].filter((n) => runs.some((r) => varies(r.observables[n])));

// The quantities that an experiment is about.
export const mainQuantities = (runs) => FIRST.map((pattern) => namesOf(runs).find((n) => pattern.test(n))).filter((n, k, all) => n && all.indexOf(n) === k).slice(0, MOST_FIRST);

// Plots of whatever the experiment measures: the main quantities, and one to choose.
function measured(runs) {
  const names = namesOf(runs);
  if (names.length === 0) return [];
  const first = mainQuantities(runs).filter((n) => n !== "lesion_area_relative");
  const slot = make("div");
  const select = make("select", { id: "observable", "aria-label": "Quantity to plot", onchange: () => slot.replaceChildren(observable(runs, select.value)) }, ...names.map((n) => make("option", { value: n }, nameOf(n))));
  select.value = names.find((n) => !first.includes(n) && runs.some((r) => moves(r.observables[n]))) ?? names[0];
  slot.append(observable(runs, select.value));
  return [...first.map((n) => mainPlot(runs, n)), make("div", { class: "choose" }, make("label", { for: "observable" }, "Also measured: "), select, slot)];
}

const PARTNER = { dcm: "deformable cell", cbm: "sphere", vessels: "vessel", walls: "wall" };

// "overlap_dcm_vessels_um": "deformable cell – vessel"
function pairOf(name) {
  const [a, b, beyond] = name.replace(/^overlap_|_um$/g, "").split("_");
  return b == null ? PARTNER[a] ?? a : `${PARTNER[a] ?? a} – ${PARTNER[b] ?? b}${beyond ? ", beyond indentation" : ""}`;
}

// The pairs that overlap most.
function overlaps(runs) {
  const deepest = (n) => Math.max(...runs.flatMap((r) => r.observables[n]?.value ?? []));
  const names = namesOf(runs).filter((n) => n.startsWith("overlap_") && n !== "overlap_vessels_um").sort((a, b) => deepest(b) - deepest(a)).slice(0, several(runs) ? 1 : MOST_CURVES);
  const title = names.length === 1 ? `Largest overlap, ${pairOf(names[0])}` : "Largest overlaps";
  return plot(title, "um", runs.flatMap((run) => names.filter((n) => run.observables[n]).map((n) => ({ ...run.observables[n], label: several(runs) ? run.name : pairOf(n), ofRun: several(runs) }))));
}

// Only of runs in which both models meet.
function interfaceForces(runs) {
  const both = runs.filter((r) => r.interface.time && r.interface.pairs.some((n) => n > 0));
  const of = (name, label) => both.map((r) => ({ time: r.interface.time, value: r.interface[name], label: named(runs, r, label), ofRun: several(runs) }));
  return [plot("Forces between deformable cells and spheres", "nN", [...of("mean force", "mean"), ...of("largest force", "largest")]),
    plot("Pairs of a deformable cell and a sphere in contact", "", of("pairs", "pairs"))];
}

// Iterations of each step from their running sum; thinned samples are several steps apart.
const differences = (c) => ({ time: c.time.slice(1), value: c.value.slice(1).map((v, k) => v - c.value[k]) });

const numerics = (runs) => [
  plot("Time step", "s", fromSeries(runs, [["dt", "step"]], { moving: true }), { log: true }),
  plot("Error estimate and largest displacement of a step", "um", fromSeries(runs, [["error", "error estimate"], ["max_move", "largest displacement"]])),
  plot("Solver iterations between samples", "", fromSeries(runs, [["cg_iterations", "iterations"]], { change: differences })),
  plot("Rejected steps, running sum", "", fromSeries(runs, [["rejections", "rejected"]])),
].filter((p) => p);

export function curves(all) {
  const runs = all.slice(0, MOST_CURVES);
  const plots = [
    lesion(runs),
    ...measured(runs),
    plot("Number of cells", "", fromSeries(runs, [["dcm_cells", "deformable cells"], ["cbm_cells", "spheres"], ["asleep", "asleep"]], { moving: true })),
    band(runs, "pressure", "Contact pressure of the cells: median, middle 50 % and 90 %", "Pa", 1000),
    band(runs, "volume", "Relative volume V/V₀: median, middle 50 % and 90 %", "", 1),
    overlaps(runs),
    ...interfaceForces(runs),
  ].filter((p) => p);
  const steps = numerics(runs);
  return make("div", {}, all.length > runs.length ? make("p", { class: "quiet" }, `Plots show the first ${runs.length} of ${all.length} runs.`) : null,
    make("div", { class: "plots" }, ...plots),
    steps.length > 0 ? make("details", { class: "numerics" }, make("summary", {}, "Time steps and solver"), make("div", { class: "plots" }, ...steps)) : null);
}
