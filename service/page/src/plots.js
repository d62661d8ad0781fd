// Curves over time.
import uPlot from "uplot";
import { make, nice, number, timeUnit } from "./text.js";

const COLOURS = ["#2f6db5", "#d06a3d", "#4f9a57", "#8e5fa8", "#b59427", "#3a9a97"];

function axisColours() {
  const style = getComputedStyle(document.documentElement);
  return { ink: style.getPropertyValue("--soft").trim(), line: style.getPropertyValue("--line").trim() };
}

// Several curves with times of their own on one axis.
function join(curves) {
  return uPlot.join(curves.map((c) => [c.time, c.value]), curves.map(() => [0, 0]));
}

// curves: [{label, time (s), value, colour?, dash?}], bands: [[upper, lower, colour]] by number of the curve
export function plot(title, unit, curves, { bands = [], log = false } = {}) {
  const used = curves.filter((c) => c.time?.length > 0);
  if (used.length === 0) return null;
  const time = timeUnit(Math.max(...used.map((c) => Math.abs(c.time.at(-1)))));
  const inUnit = used.map((c) => ({ ...c, time: c.time.map((t) => t / time.size) }));
  return draw(title, `${nice(unit)}`, `time, ${time.name}`, join(inUnit), used, { bands, log });
}

// y over any x
export function plotXY(title, unit, xLabel, curves, options = {}) {
  const used = curves.filter((c) => c.time?.length > 0);
  if (used.length === 0) return null;
  return draw(title, nice(unit), xLabel, join(used), used, options);
}

function draw(title, unit, xLabel, data, curves, { bands = [], log = false, x = {} }) {
  const box = make("figure", { class: "plot" }, make("figcaption", {}, title, unit ? make("span", { class: "unit" }, ` ${unit}`) : null));
  const { ink, line } = axisColours();
  const axis = (label) => ({ stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, label, labelSize: 18, font: "11px system-ui", labelFont: "11px system-ui", size: label ? 34 : 56,
    values: (_, ticks) => ticks.map((v) => (v == null ? "" : number(v))) });
  const options = {
    width: 380, height: 210, scales: { x: { time: false, ...x }, y: log ? { distr: 3 } : {} }, cursor: { y: false, points: { size: 6 } },
    legend: { live: true }, bands: bands.map(([a, b, fill]) => ({ series: [a + 1, b + 1], fill })),
    axes: [axis(xLabel), axis()],
    series: [{ label: xLabel, value: (_, v) => number(v) }, ...curves.map((c, k) => ({
      label: c.label, stroke: c.colour ?? COLOURS[k % COLOURS.length], width: c.width ?? 1.6, dash: c.dash, spanGaps: true, points: { show: c.points ?? false, size: 5 },
      value: (_, v) => (v == null ? "–" : number(v)) }))],
  };
  // Drawn when it comes near the screen: a page has many.
  const watch = new IntersectionObserver((seen) => {
    if (!seen.some((s) => s.isIntersecting)) return;
    watch.disconnect();
    options.width = Math.max(240, box.clientWidth - 4);
    const chart = new uPlot(options, data, box);
    new ResizeObserver(() => chart.setSize({ width: Math.max(240, box.clientWidth - 4), height: 210 })).observe(box);
  }, { rootMargin: "600px" });
  watch.observe(box);
  return box;
}

export const runColour = (k) => COLOURS[k % COLOURS.length];
