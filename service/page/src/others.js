// Laws, studies, comparisons.
import { plotXY } from "./plots.js";
import { duration, make, nice, number, table } from "./text.js";

export function law(item) {
  const l = item.law;
  const plots = [];
  const modulus = (curve) => ({ time: curve.map((p) => p.overlap), value: curve.map((p) => 1000 * p.modulus_kPa) });
  if (l.table?.length) plots.push(plotXY("Contact modulus of the spheres", "Pa", "overlap over radius", [{ label: "modulus", ...modulus(l.table), points: true }], { log: true }));
  if (item.curves) {
    const forces = Object.entries(item.curves).filter(([, c]) => c?.overlap && (c.force ?? c.mean_force ?? c.force_nN));
    const sorted = forces.map(([name, c]) => {
      const y = c.force ?? c.mean_force ?? c.force_nN;
      const order = c.overlap.map((_, k) => k).sort((a, b) => c.overlap[a] - c.overlap[b]);
      return { label: name, time: order.map((k) => c.overlap[k]), value: order.map((k) => y[k]) };
    });
    plots.push(plotXY("Mean contact force in the compressed clump", "nN", "overlap over radius", sorted));
  }
  const rows = [];
  const walk = (o, path) => {
    for (const [k, v] of Object.entries(o)) {
      if (k === "table") continue;
      if (v && typeof v === "object" && !Array.isArray(v)) walk(v, `${path}${k}.`);
      else rows.push([make("code", {}, path + k), Array.isArray(v) ? v.map(number).join(" – ") : number(v)]);
    }
  };
  walk(l, "");
  return make("div", {}, make("div", { class: "headline" }, make("h2", {}, item.name), make("span", { class: "badge law" }, "calibrated law")),
    make("div", { class: "plots" }, ...plots.filter((p) => p)), make("h3", {}, "The law"), table(["key", "value"], rows, "The law"));
}

export function study(item) {
  const verdicts = item.verdicts.map((v) => [
    make("span", { class: v.pass === true ? "pass" : v.pass === false ? "fail" : "open" }, v.verdict), v.id, v.claim,
    v.expected, v.measured == null ? "–" : `${number(v.measured)} ${nice(v.unit ?? "")}${v.low !== v.high ? ` [${number(v.low)}, ${number(v.high)}]` : ""}`]);
  const [head, ...runs] = item.runs;
  const image = (p) => make("figure", { class: "plot" }, make("img", { alt: `plot ${p.name}`, src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(p.svg)}` }));
  return make("div", {}, make("div", { class: "headline" }, make("h2", {}, item.name), make("span", { class: "badge study" }, "study")),
    verdicts.length > 0 ? make("h3", {}, "Claims") : null,
    verdicts.length > 0 ? table(["verdict", "", "claim", "expected", "measured: mean [smallest, largest]"], verdicts, "Claims") : null,
    make("div", { class: "plots" }, ...item.plots.map(image)),
    make("details", {}, make("summary", {}, `${runs.length} runs`), table(head ?? [], runs, "Runs")));
}

export function comparison(c, names) {
  if (c.fault) return make("p", { class: "quiet" }, `No comparison of the runs: ${c.fault}`);
  const parts = c.runs.flatMap((rows, k) => [make("h3", {}, `${names[k + 1]} against ${names[0]}`), table(["quantity", names[0], names[k + 1], "", "difference"], rows.map((d) => [
    d.name, number(d.reference), number(d.value), nice(d.unit), d.difference == null ? "–" : d.absolute ? `${number(d.difference)} ${nice(d.unit)}` : `${number(+(100 * d.difference).toPrecision(3))} %`]),
    `${names[k + 1]} against ${names[0]}`)]);
  return make("div", {}, make("p", { class: "quiet" }, `${c.frames} ${c.frames === 1 ? "frame" : "frames"} from ${duration(c.from)} to ${duration(c.to)}. Means over cells and frames.`), ...parts, ...c.notes.map((n) => make("p", { class: "quiet" }, n)));
}
