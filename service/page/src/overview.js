// What a run is, how it ended, and how far it can be trusted.
import { mainQuantities } from "./curves.js";
import { nameOf, shownIn, unitOfName } from "./names.js";
import { cellCounts, duration, make, nice, number, table, tiles } from "./text.js";

const MOST_RESULTS = 4;
const MODEL_PRESSURES = [["dcm", "contact_pressure_mean_dcm_Pa"], ["cbm", "contact_pressure_mean_cbm_Pa"]]; // both in a hybrid
const NO_RESULT = /^(max_overlap|wall_s|cpu_s|radius_um|adhesion_energy)/; // checks, costs, input

function status(run) {
  if (run.going_on) return ["running", "is being written"];
  const s = run.summary.status ?? run.provenance.status;
  if (!s) return ["unfinished", "has no end: killed, or stopped before its summary was written"];
  return [s, run.summary.cause ?? ""];
}

// Name, description, end, verdict of the checks.
export function header(run) {
  const [word, why] = status(run);
  const failed = run.checks.filter((c) => !c.pass).length;
  const verdict = run.checks.length === 0 ? null
    : make("span", { class: `badge ${failed > 0 ? "failed" : "completed"}` }, failed > 0 ? `${failed} of ${run.checks.length} checks failed` : `all ${run.checks.length} checks passed`);
  return make("div", {}, make("div", { class: "headline" }, make("h2", {}, run.name), make("span", { class: `badge ${word}` }, word), verdict, why ? make("span", { class: "why" }, why) : null),
    run.scene?.description ? make("p", { class: "about" }, sentence(run.scene.description)) : null, tiles(keyFigures(run)));
}

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");

// What a reader asks first: how many cells, how long, and the results of the experiment.
function keyFigures(run) {
  const s = run.summary;
  const last = (curve) => curve.value.findLast((v) => v != null);
  const tile = (name) => {
    const [factor, unit] = shownIn(run.observables[name].unit);
    const value = last(run.observables[name]);
    return [nameOf(name), value == null ? "–" : `${number(factor * value)} ${nice(unit)}`];
  };
  const pressures = MODEL_PRESSURES.filter(([model, name]) => run.observables[name] && (s.cells ? s.cells[model] > 0 : last(run.observables[name]) > 0));
  const both = pressures.length > 1 ? pressures.map(([, name]) => tile(name)) : [];
  const curves = mainQuantities([run]).filter((name) => both.length === 0 || !/pressure_mean/.test(name)).map(tile);
  const results = Object.entries(run.results ?? {}).filter(([name]) => !NO_RESULT.test(name)).map(([name, value]) => [nameOf(name), `${number(value)} ${unitOfName(name)}`]);
  const frames = run.frames.list;
  return [
    ["Cells", s.cells ? cellCounts(s.cells) : frames.length > 0 ? String(frames.at(-1).cells) : "–"],
    ["Simulated time", s.simulated_s == null ? (frames.length > 0 ? duration(frames.at(-1).time) : "–") : duration(s.simulated_s)],
    ...[...results, ...curves].slice(0, MOST_RESULTS), ...both,
  ];
}

function facts(run) {
  const s = run.summary;
  const p = run.provenance;
  const rows = [
    ["Scene", s.scene],
    ["Simulated", s.simulated_s == null ? null : duration(s.simulated_s) + (s.start_up_s ? ` after ${duration(s.start_up_s)} of start-up` : "")],
    ["Cells at the end", s.cells ? cellCounts(s.cells) : null],
    ["Divisions, deaths", s.cells && s.cells.divisions + s.cells.deaths > 0 ? `${s.cells.divisions}, ${s.cells.deaths}` : null],
    ["Steps", s.steps ? `${s.steps.accepted} accepted, ${s.steps.rejected} rejected` : null],
    ["Wall and CPU time", s.wall_s == null ? null : `${duration(s.wall_s)}, ${duration(s.cpu_s)} on ${s.threads} thread${s.threads === 1 ? "" : "s"}`],
    ["Memory", s.peak_rss_bytes ? `${number(s.peak_rss_bytes / 1e6)} MB` : null],
    ["Seed", s.seed ?? p.seed],
    ["Program", `acinus ${p.version ?? s.version ?? ""}`],
    ["Command", p.command_line],
    ["Started, ended", p.start ? `${p.start}${p.end ? ` – ${p.end}` : ""}` : null],
    ["Hash of the final state", s.state_hash],
    ["Frames", `${run.frames.list.length} of ${run.frames.in_file} on this page`],
  ];
  return make("dl", { class: "facts" }, ...rows.filter(([, v]) => v != null && v !== "").flatMap(([k, v]) => [make("dt", {}, k), make("dd", {}, String(v))]));
}

function checks(run) {
  if (run.checks.length === 0) return null;
  const rows = run.checks.map((c) => [
    make("span", { class: c.pass ? "pass" : "fail" }, c.pass ? "pass" : "fail"), c.name, `${number(c.value)} ${nice(c.unit)}`, `${c.at_most ? "at most" : "at least"} ${number(c.limit)} ${nice(c.unit)}`,
  ]);
  return make("div", {}, make("h3", {}, "Checks"), table(["", "check", "measured", "allowed"], rows, "Checks"));
}

function notes(run) {
  const warnings = [...run.damage.map((d) => `Unreadable: ${d}`), ...(run.summary.warnings ?? [])];
  if (run.frames.list.length < run.frames.in_file)
    warnings.push(`The page shows ${run.frames.list.length} of ${run.frames.in_file} frames, to stay small. The options --frames and --limit of acinus report allow more.`);
  if (warnings.length === 0) return null;
  return make("ul", { class: "warnings" }, ...warnings.map((w) => make("li", {}, w)));
}

// Wall time per stage over all attempts, and of the last one if the run was resumed.
function stages(run) {
  const { timings = {}, timings_last_attempt: last = {}, attempts = 1 } = run.summary;
  const times = Object.entries(timings).filter(([, s]) => s > 0).sort((a, b) => b[1] - a[1]);
  if (times.length === 0) return null;
  const most = times[0][1];
  const sum = times.reduce((a, [, s]) => a + s, 0);
  const resumed = attempts > 1;
  const head = resumed ? [make("span", {}), make("span", {}), make("span", { class: "amount" }, "all attempts · share"), make("span", { class: "amount" }, "last attempt")] : [];
  return make("div", {}, make("h3", {}, "Wall time per stage"),
    make("p", { class: "quiet" }, `Rejected steps are included.${resumed ? ` Sum over ${attempts} attempts: the run was resumed ${attempts === 2 ? "once" : `${attempts - 1} times`}.` : ""}`),
    make("div", { class: resumed ? "bars resumed" : "bars" }, ...head, ...times.flatMap(([name, s]) => [
      make("span", {}, name), make("i", { style: `width:${Math.max(0.5, (100 * s) / most)}%` }), make("span", { class: "amount" }, `${duration(s)} · ${number(+((100 * s) / sum).toPrecision(2))} %`),
      ...(resumed ? [make("span", { class: "amount" }, last[name] > 0 ? duration(last[name]) : "–")] : [])])));
}

const plain = (value) => (value === null ? "none" : typeof value === "string" ? value : Array.isArray(value) ? value.map(plain).join(", ") || "empty" : JSON.stringify(value));

function scene(run) {
  if (!run.changed) return null;
  const rows = run.changed.map((c) => [make("code", { title: c.meaning }, c.key), plain(c.value), c.default === null ? "–" : plain(c.default), c.meaning]);
  return make("details", { class: "scene" }, make("summary", {}, `Scene: ${rows.length} values that are not the defaults`),
    table(["key", "value", "default", "meaning"], rows, "Scene, differences from the defaults"),
    make("details", {}, make("summary", {}, "The whole scene"), make("pre", {}, JSON.stringify(run.scene, null, 1))));
}

function skipped(run) {
  const list = run.summary.skipped ?? [];
  if (list.length === 0) return null;
  return make("p", { class: "quiet" }, `Not computed, because the scene does not need it: ${list.join(", ")}.`);
}

export function overview(run) {
  return make("div", {}, notes(run), make("div", { class: "columns" }, make("div", {}, facts(run)), make("div", {}, checks(run), stages(run), skipped(run))), scene(run));
}

export function events(run) {
  const { counts, last, all } = run.events;
  if (!all) return null;
  const rows = last.map(([t, code, message, cells]) => [duration(t), code, cells.join(", "), message]);
  const kinds = Object.entries(counts).map(([code, n]) => `${n} × ${code}`).join(", ");
  return make("details", {}, make("summary", {}, `Events: ${kinds}${last.length < all ? ` (the last ${last.length} below)` : ""}`), table(["time", "event", "cells", ""], rows, "Events"));
}
