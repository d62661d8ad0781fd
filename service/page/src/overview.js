// What a run is, how it ended, and how far it can be trusted.
import { duration, make, nice, number, table } from "./text.js";

function status(run) {
  if (run.going_on) return ["running", "is being written"];
  const s = run.summary.status ?? run.provenance.status;
  if (!s) return ["unfinished", "has no end: killed, or stopped before its summary was written"];
  return [s, run.summary.cause ?? ""];
}

export function header(run) {
  const [word, why] = status(run);
  return make("div", { class: "headline" }, make("h2", {}, run.name), make("span", { class: `badge ${word}` }, word), why ? make("span", { class: "why" }, why) : null);
}

function facts(run) {
  const s = run.summary;
  const p = run.provenance;
  const rows = [
    ["Scene", s.scene],
    ["Simulated", s.simulated_s == null ? null : duration(s.simulated_s) + (s.start_up_s ? ` after ${duration(s.start_up_s)} of start-up` : "")],
    ["Cells at the end", s.cells ? `${s.cells.dcm} deformable, ${s.cells.cbm} spheres` : null],
    ["Divisions, deaths", s.cells ? `${s.cells.divisions}, ${s.cells.deaths}` : null],
    ["Steps", s.steps ? `${s.steps.accepted} accepted, ${s.steps.rejected} rejected` : null],
    ["Wall and CPU time", s.wall_s == null ? null : `${duration(s.wall_s)}, ${duration(s.cpu_s)} on ${s.threads} thread${s.threads === 1 ? "" : "s"}`],
    ["Memory", s.peak_rss_bytes ? `${number(s.peak_rss_bytes / 1e6)} MB` : null],
    ["Seed", s.seed ?? p.seed],
    ["Program", `${p.version ?? s.version ?? ""} (${p.git ?? s.git ?? ""})`],
    ["Command", p.command_line],
    ["Begun, ended", p.start ? `${p.start}${p.end ? ` – ${p.end}` : ""}` : null],
    ["Final state", s.state_hash],
    ["Frames", `${run.frames.list.length} of ${run.frames.in_file} shown`],
  ];
  return make("dl", { class: "facts" }, ...rows.filter(([, v]) => v != null && v !== "").flatMap(([k, v]) => [make("dt", {}, k), make("dd", {}, String(v))]));
}

function checks(run) {
  if (run.checks.length === 0) return null;
  const rows = run.checks.map((c) => [
    make("span", { class: c.pass ? "pass" : "fail" }, c.pass ? "pass" : "fail"), c.name, `${number(c.value)} ${nice(c.unit)}`, `${c.at_most ? "at most" : "at least"} ${number(c.limit)} ${nice(c.unit)}`,
  ]);
  return make("div", {}, make("h3", {}, "Balances and checks"), table(["", "what", "here", "asked"], rows, "Balances and checks"));
}

function notes(run) {
  const warnings = [...run.damage.map((d) => `Not readable: ${d}`), ...(run.summary.warnings ?? [])];
  if (run.frames.list.length < run.frames.in_file)
    warnings.push(`The page shows ${run.frames.list.length} of ${run.frames.in_file} frames, to stay small; acinus report --frames and --limit allow more.`);
  if (warnings.length === 0) return null;
  return make("ul", { class: "warnings" }, ...warnings.map((w) => make("li", {}, w)));
}

function stages(run) {
  const times = Object.entries(run.summary.timings ?? {}).filter(([, s]) => s > 0).sort((a, b) => b[1] - a[1]);
  if (times.length === 0) return null;
  const most = times[0][1];
  const sum = times.reduce((a, [, s]) => a + s, 0);
  return make("div", {}, make("h3", {}, "Where the time went"), make("div", { class: "bars" }, ...times.flatMap(([name, s]) => [
    make("span", {}, name), make("i", { style: `width:${Math.max(0.5, (100 * s) / most)}%` }), make("span", { class: "amount" }, `${duration(s)} · ${number(+((100 * s) / sum).toPrecision(2))} %`)])));
}

const plain = (value) => (value === null ? "none" : typeof value === "string" ? value : JSON.stringify(value));

function valueOf(text) {
  try {
    return JSON.parse(text);
  } catch {
    return text; // "absent", "3 entries"
  }
}

// Every value in a block that the defaults do not have: [key, text].
function leaves(key, value) {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return [[key, plain(value)]];
  return Object.entries(value).flatMap(([name, inner]) => leaves(`${key}.${name}`, inner));
}

function scene(run) {
  if (!run.differences) return null;
  const lines = run.differences.flatMap((d) => {
    const colon = d.indexOf(": ");
    const [then, ...now] = d.slice(colon + 2).split(" -> ");
    return leaves(d.slice(1, colon).replaceAll("/", "."), valueOf(now.join(" -> "))).map(([key, here]) => [make("code", {}, key), here, plain(valueOf(then))]);
  });
  return make("details", { class: "scene" }, make("summary", {}, `Scene: ${lines.length} values that are not the defaults`),
    table(["key", "here", "default"], lines, "Scene, differences from the defaults"),
    make("details", {}, make("summary", {}, "The whole scene"), make("pre", {}, JSON.stringify(run.scene, null, 1))));
}

function skipped(run) {
  const list = run.summary.skipped ?? [];
  if (list.length === 0) return null;
  return make("p", { class: "quiet" }, `Skipped, because the scene does not need it: ${list.join(", ")}.`);
}

export function overview(run) {
  return make("div", {}, notes(run), make("div", { class: "columns" }, make("div", {}, facts(run)), make("div", {}, checks(run), stages(run), skipped(run))), scene(run));
}

export function events(run) {
  const { counts, last, all } = run.events;
  if (!all) return null;
  const rows = last.map(([t, code, message, cells]) => [duration(t), code, cells.join(", "), message]);
  const told = Object.entries(counts).map(([code, n]) => `${n} × ${code}`).join(", ");
  return make("details", {}, make("summary", {}, `Events: ${told}${last.length < all ? ` (the last ${last.length} below)` : ""}`), table(["time", "event", "cells", ""], rows, "Events"));
}
