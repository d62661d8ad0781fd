// Curves over time.
import uPlot from "uplot";
import { make, nice, number, timeUnit } from "./text.js";

const COLOURS = ["#2f6db5", "#d06a3d", "#4f9a57", "#8e5fa8", "#b59427", "#3a9a97"];
export const MOST_CURVES = 5; // labelled ones in a plot
const HEIGHT = 210;

function axisColours() {
  const style = getComputedStyle(document.documentElement);
  return { ink: style.getPropertyValue("--soft").trim(), line: style.getPropertyValue("--line").trim() };
}

// Several curves with times of their own on one axis.
function join(curves) {
  return uPlot.join(curves.map((c) => [c.time, c.value]), curves.map(() => [0, 0]));
}

// Curves with data, at most MOST_CURVES with a label, each of these with a colour of its own; `left` counts the others.
function choose(curves) {
  const used = curves.filter((c) => c.time?.length > 0);
  const labelled = used.filter((c) => c.label != null);
  const kept = labelled.slice(0, MOST_CURVES);
  const shown = used.filter((c) => c.label == null || kept.includes(c)).map((c) => (c.label == null ? c : { ...c, colour: c.colour ?? COLOURS[kept.indexOf(c)] }));
  return { shown, left: labelled.length - kept.length };
}

// curves: [{label, time (s), value, colour?, ofRun? (the label names a run)}], those without a label bound bands; bands: [[upper, lower, colour]] by number of the curve
export function plot(title, unit, curves, { bands = [], log = false } = {}) {
  const { shown, left } = choose(curves);
  if (shown.length === 0) return null;
  const time = timeUnit(Math.max(...shown.map((c) => Math.abs(c.time.at(-1)))));
  const inUnit = shown.map((c) => ({ ...c, time: c.time.map((t) => t / time.size) }));
  return draw(title, nice(unit), ["time", time.name], join(inUnit), shown, left, { bands, log });
}

// y over any x
export function plotXY(title, unit, xLabel, curves, options = {}) {
  const { shown, left } = choose(curves);
  if (shown.length === 0) return null;
  return draw(title, nice(unit), [xLabel, ""], join(shown), shown, left, options);
}

// One curve needs no legend where the title names it; with several runs on the page it does not.
function legend(curves, left) {
  const named = curves.filter((c) => c.label != null);
  if (named.length < 2 && !named[0]?.ofRun) return null;
  return make("div", { class: "curves" }, ...named.map((c) => make("span", { class: "class" }, make("i", { style: `background:${c.colour}` }), c.label)),
    left > 0 ? make("span", { class: "quiet" }, `${left} more not drawn`) : null);
}

// The value nearest to a place in joined data, where curves without a sample have none.
function valueNear(values, at) {
  for (let step = 0; step < values.length; ++step) for (const k of [at - step, at + step]) if (values[k] != null) return values[k];
  return null;
}

// Values under the pointer, beside it.
function tooltip([xName, xUnit], unit, curves) {
  const box = make("div", { class: "tip", hidden: true });
  const named = curves.map((c, k) => [c, k]).filter(([c]) => c.label != null);
  return {
    hooks: {
      init: (u) => u.over.append(box),
      setCursor: (u) => {
        const at = u.cursor.idx;
        box.hidden = at == null || u.cursor.left < 0;
        if (box.hidden) return;
        box.replaceChildren(make("div", { class: "quiet" }, `${xName} ${number(u.data[0][at])} ${xUnit}`),
          ...named.map(([c, k]) => make("div", {}, make("i", { style: `background:${c.colour}` }), `${named.length > 1 ? `${c.label}: ` : ""}${number(valueNear(u.data[k + 1], at))} ${unit}`)));
        const right = u.cursor.left > u.over.clientWidth / 2;
        box.style.left = right ? "" : `${u.cursor.left + 12}px`;
        box.style.right = right ? `${u.over.clientWidth - u.cursor.left + 12}px` : "";
      },
    },
  };
}

function draw(title, unit, x, data, curves, left, { bands = [], log = false, range = {} }) {
  const box = make("figure", { class: "plot" }, make("figcaption", {}, title, unit ? make("span", { class: "unit" }, ` ${unit}`) : null));
  const place = make("div", { class: "chart" });
  box.append(place, ...[legend(curves, left)].filter((l) => l));
  const { ink, line } = axisColours();
  const xLabel = x[1] ? `${x[0]}, ${x[1]}` : x[0];
  const axis = (label) => ({ stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, label, labelSize: 18, font: "11px system-ui", labelFont: "11px system-ui", size: label ? 34 : 56,
    values: (_, ticks) => ticks.map((v) => (v == null ? "" : number(v))) });
  const options = {
    width: 380, height: HEIGHT, scales: { x: { time: false, ...range }, y: log ? { distr: 3 } : {} }, cursor: { y: false, points: { size: 6 } },
    legend: { show: false }, bands: bands.map(([a, b, fill]) => ({ series: [a + 1, b + 1], fill })), plugins: [tooltip(x, unit, curves)],
    axes: [axis(xLabel), axis()],
    series: [{ label: xLabel }, ...curves.map((c) => ({
      label: c.label ?? "", stroke: c.colour, width: c.width ?? 1.6, spanGaps: true, points: { show: c.points ?? false, size: 5 } }))],
  };
  // Drawn when it comes near the screen: a page has many.
  const watch = new IntersectionObserver((seen) => {
    if (!seen.some((s) => s.isIntersecting)) return;
    watch.disconnect();
    const width = () => Math.max(240, box.clientWidth - 24);
    const chart = new uPlot({ ...options, width: width() }, data, place);
    new ResizeObserver(() => chart.setSize({ width: width(), height: HEIGHT })).observe(box);
  }, { rootMargin: "600px" });
  watch.observe(box);
  return box;
}

export const runColour = (k) => COLOURS[k % COLOURS.length];
