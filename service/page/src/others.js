// Laws, studies, comparisons.
import { shownIn } from "./names.js";
import { plotXY } from "./plots.js";
import { duration, make, nice, number, table, tiles } from "./text.js";

const headline = (name, kind, word, ...badges) => make("div", { class: "headline" }, make("h2", {}, name), make("span", { class: `badge ${kind}` }, word), ...badges);

// "cortex_young_kPa", 1: ["cortex, Young's modulus", "1000 Pa"]
const ENDINGS = [["_nN_per_um", "mN/m"], ["_kPa_per_um", "kPa/µm"], ["_kPa", "kPa"], ["_um", "µm"]];
const CONSTANTS = { young: "Young's modulus", poisson: "Poisson ratio", cortex_young: "cortex, Young's modulus", cortex_poisson: "cortex, Poisson ratio", adhesion: "adhesion energy per area", nodes: "nodes per cell" };
function constant(key, value) {
  if (key === "adhesion_nN_per_um") return [CONSTANTS.adhesion, `${number(+(1e-3 * value).toPrecision(6))} J/m²`];
  const [ending, unit] = ENDINGS.find(([e]) => key.endsWith(e)) ?? ["", ""];
  const [factor, shown] = shownIn(unit);
  const name = key.slice(0, key.length - ending.length);
  return [CONSTANTS[name] ?? name.replaceAll("_", " "), typeof value === "number" ? `${number(+(factor * value).toPrecision(6))} ${shown}` : String(value)];
}

const LAW_CURVES = { dcm: "deformable cells", cbm: "plain spheres", jkr: "JKR", cbm_corrected: "spheres with this law" };

// Modulus and range of the overlap d as the law applies them: from its table, or from its power law.
function rangesOf(l) {
  if (l.table?.length > 0) return { modulus: [l.table[0].modulus_kPa, l.table.at(-1).modulus_kPa], overlap: [l.table[0].overlap, l.table.at(-1).overlap] };
  return { modulus: null, overlap: l.overlap_range ?? null };
}

const percent = (share) => `${number(+(100 * share).toPrecision(3))} %`;
const span = ([a, b], unit) => `${number(a)} to ${number(b)}${unit}`;

export function law(item) {
  const l = item.law;
  const { modulus, overlap } = rangesOf(l);
  const plots = [];
  if (l.table?.length) plots.push(plotXY("Contact modulus of the spheres", "Pa", "relative overlap d", [{ label: "modulus", time: l.table.map((p) => p.overlap), value: l.table.map((p) => 1000 * p.modulus_kPa), points: true }], { log: true }));
  if (item.curves) {
    const forces = Object.entries(item.curves).filter(([, c]) => c?.overlap && (c.force ?? c.mean_force ?? c.force_nN));
    const sorted = forces.map(([name, c]) => {
      const y = c.force ?? c.mean_force ?? c.force_nN;
      const order = c.overlap.map((_, k) => k).sort((a, b) => c.overlap[a] - c.overlap[b]);
      return { label: LAW_CURVES[name] ?? name.replaceAll("_", " "), time: order.map((k) => c.overlap[k]), value: order.map((k) => y[k]) };
    });
    plots.push(plotXY("Mean contact force in the compressed clump", "nN", "relative overlap d", sorted));
  }
  const figures = [
    ["Contact modulus", modulus ? span(modulus.map((m) => 1000 * m), " Pa") : `${number(1000 * l.a0_kPa)} Pa + ${number(1000 * l.a1_kPa)} Pa · d^${number(l.power)}`],
    overlap ? ["Range of d", span(overlap, "")] : null,
    l.r_squared == null ? null : ["R² of the fit", number(l.r_squared)],
    l.rms_relative == null ? null : ["Rms deviation", percent(l.rms_relative)],
    l.wall_recess == null ? null : ["Recess at walls", `${number(+l.wall_recess.toPrecision(3))} of the radius`],
    l.friction_share == null ? null : ["Friction, share of that of deformable cells", percent(l.friction_share)],
    l.jkr_underestimation == null ? null : ["Force over that of JKR", `${number(l.jkr_underestimation)} times`],
  ].filter((f) => f);
  const constants = (block, title) => (block ? make("div", {}, make("h3", {}, title), table(["constant", "value"], Object.entries(block).map(([k, v]) => constant(k, v)), title)) : null);
  const origin = Object.entries(l.provenance ?? {}).filter(([k]) => k !== "git").map(([k, v]) => [k.replaceAll("_", " "), v]);
  const warnings = l.warnings ?? [];
  return make("div", {}, headline(item.name, "law", "calibrated law", warnings.length > 0 ? make("span", { class: "badge failed" }, "see the warnings") : null),
    warnings.length > 0 ? make("ul", { class: "warnings banner", role: "alert" }, ...warnings.map((w) => make("li", {}, w))) : null,
    make("p", { class: "about" }, "Contact law of spheres, fitted to the forces between deformable cells in a compressed clump. d is the relative overlap of a cell: the sum of 1 - distance / (sum of both radii) over its neighbours, divided by twelve."),
    tiles(figures), make("div", { class: "plots spaced" }, ...plots.filter((p) => p)),
    make("div", { class: "columns" }, constants(l.dcm, "Deformable cells"), constants(l.cbm, "Spheres")),
    make("details", {}, make("summary", {}, "How it was made"), table(["", ""], origin, "Provenance")));
}

// Rows of the table below a heading of the study's report, without those of the head.
function tableUnder(text, heading) {
  const lines = text.split("\n");
  const rows = [];
  for (let k = lines.indexOf(`## ${heading}`) + 1; k > 0 && k < lines.length && !lines[k].startsWith("## "); ++k) if (lines[k].startsWith("| ")) rows.push(lines[k].slice(2, -2).split(" | "));
  return rows.slice(1);
}

// "a.b = 1, c = [2, 3]": a change begins with a key
const changesIn = (text) => (text === "" ? [] : text.split(/, (?=[\w.<>-]+ = )/));

function variants(text) {
  const rows = tableUnder(text, "Variants").map(([name, changes, start, seeds]) => ({ name, changes: changesIn(changes), start, seeds }));
  if (rows.length === 0) return null;
  const common = rows.length > 1 ? rows[0].changes.filter((c) => rows.every((r) => r.changes.includes(c))) : [];
  const list = (changes) => make("span", {}, ...changes.flatMap((c, k) => [k > 0 ? make("br") : null, make("code", {}, c)]));
  return make("div", {}, make("h3", {}, "Variants"), common.length > 0 ? make("p", {}, "All runs: ", ...common.flatMap((c, k) => [k > 0 ? ", " : null, make("code", {}, c)])) : null,
    table(["variant", "changes to the scene", "seeds"], rows.map((r) => {
      const own = r.changes.filter((c) => !common.includes(c));
      return [r.name, own.length > 0 ? list(own) : "none", r.seeds];
    }), "Variants"));
}

function runsOf(item) {
  const [head, ...rows] = item.runs;
  const at = (name) => (head ?? []).indexOf(name);
  const link = (row, k) => (item.links?.[k] ? make("a", { href: encodeURI(`${item.path}/${item.links[k]}`) }, row[at("run")]) : row[at("run")]);
  const time = (text) => (text === "" || text == null ? "–" : duration(+text));
  return table(["run", "state", "simulated", "wall time", "cause"], rows.map((row, k) => [link(row, k), row[at("state")], time(row[at("simulated_s")]), time(row[at("wall_s")]), row[at("cause")] ?? ""]), "Runs");
}

export function study(item) {
  const verdicts = item.verdicts.map((v) => [
    make("span", { class: v.pass === true ? "pass" : v.pass === false ? "fail" : "open" }, v.verdict), v.claim, v.expected,
    v.measured == null ? "–" : `${quantity(v.measured, v.unit)}${v.low !== v.high ? ` [${quantity(v.low, v.unit)}, ${quantity(v.high, v.unit)}]` : ""}`]);
  const text = item.text ?? "";
  const paragraphs = text.split("\n\n");
  const about = paragraphs[1]?.startsWith("Scene ") ? "" : paragraphs[1] ?? "";
  const scene = text.match(/^Scene (.+?)\. \d+ runs/m)?.[1];
  const done = item.runs.slice(1).filter((r) => r[(item.runs[0] ?? []).indexOf("state")] === "done").length;
  const holding = item.verdicts.filter((v) => v.pass === true).length;
  const verdict = item.verdicts.length > 0 ? make("span", { class: `badge ${holding === item.verdicts.length ? "completed" : "failed"}` }, `${holding} of ${item.verdicts.length} claims hold`) : null;
  const image = (p) => make("figure", { class: "plot" }, make("img", { alt: `plot ${p.name}`, src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(p.svg)}` }));
  return make("div", {}, headline(item.name, "study", "study", verdict), about ? make("p", { class: "about" }, about.charAt(0).toUpperCase() + about.slice(1)) : null,
    tiles([...(scene ? [["Scene", scene]] : []), ["Runs", `${done} of ${item.runs.length - 1} done`]]),
    verdicts.length > 0 ? make("h3", {}, "Claims") : null,
    verdicts.length > 0 ? table(["verdict", "claim", "expected", "measured: mean [smallest, largest]"], verdicts, "Claims") : null,
    make("div", { class: "plots spaced" }, ...item.plots.map(image)), variants(text), make("h3", {}, "Runs"), runsOf(item));
}

function quantity(value, unit) {
  if (unit === "s") return duration(value);
  const [factor, shown] = shownIn(unit);
  return `${number(factor * value)} ${nice(shown)}`.trim();
}

const COMPARED = {
  cells: "cells at the end", positions: "positions of the same cells, rms distance", density: "density of the inner half", pressure: "mean contact pressure over time",
  cell_pressure: "contact pressure of the same cells, rms", contact_force: "mean contact force over time", cell_force: "contact force of the same cells, rms",
  contacts: "mean number of neighbours over time", lesion_area: "lesion area, nearest cells", flooded_area: "lesion area open to the central vein",
  overlap: "overlap of the central cell", normal_force: "normal forces on the central cell", cpu: "CPU time",
};
const LONG_NOTE = 200;

export function comparison(c, names) {
  if (c.fault) return make("p", { class: "quiet" }, `These runs cannot be compared: ${c.fault}`);
  const others = names.slice(1);
  const quantities = [...new Set(c.runs.flatMap((rows) => rows.map((d) => d.name)))];
  const signed = (share) => `${share > 0 ? "+" : ""}${percent(share)}`;
  const change = (d) => (d.change == null ? "" : ` · ${signed(d.change)}`);
  const rms = (d) => (d.rms == null || d.absolute ? "" : ` · rms ${percent(d.rms)}`);
  const cell = (d) => (d == null || d.value == null ? "–" : make("span", {}, quantity(d.value, d.unit), make("span", { class: "quiet" }, change(d) + rms(d))));
  const rows = quantities.map((name) => {
    const of = c.runs.map((rows) => rows.find((d) => d.name === name));
    const first = of.find((d) => d?.reference != null);
    return [COMPARED[name] ?? name.replaceAll("_", " "), first ? quantity(first.reference, first.unit) : "–", ...of.map(cell)];
  });
  const notes = [...new Set(c.notes)];
  const isLong = (n) => n.length > LONG_NOTE;
  return make("div", {}, make("p", { class: "quiet" }, `${c.frames} common ${c.frames === 1 ? "frame" : "frames"}${c.from === c.to ? `, at ${duration(c.to)}` : ` from ${duration(c.from)} to ${duration(c.to)}`}. Percentages without a word: change relative to ${names[0]}. Rms: of the difference over time, relative to the rms of ${names[0]}; frames far from rest, such as the first, weigh most.`),
    table(["quantity", names[0], ...others], rows, "Comparison"), ...notes.filter((n) => !isLong(n)).map((n) => make("p", { class: "quiet" }, n)),
    ...notes.filter(isLong).map((n) => make("details", {}, make("summary", {}, n.split(": ")[0]), make("ul", {}, ...n.slice(n.indexOf(": ") + 2).split("; ").map((d) => make("li", {}, d))))));
}
