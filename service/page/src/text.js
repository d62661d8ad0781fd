// Elements and numbers as people read them.

export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter((c) => c != null));
  return element;
}

export function number(value) {
  if (value == null || Number.isNaN(value)) return "–";
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e7) return String(value);
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(2).replace(/\.?0+e/, "e") : String(+value.toPrecision(4));
}

export function duration(seconds) {
  if (seconds == null) return "–";
  const s = Math.abs(seconds);
  if (s < 120) return `${number(+seconds.toPrecision(3))} s`;
  if (s < 7200) return `${number(+(seconds / 60).toPrecision(3))} min`;
  if (s < 48 * 3600) return `${number(+(seconds / 3600).toPrecision(3))} h`;
  return `${number(+(seconds / 86400).toPrecision(3))} d`;
}

export function bytes(n) {
  const [size, unit] = n < 1e6 ? [1e3, "kB"] : n < 1e9 ? [1e6, "MB"] : [1e9, "GB"];
  return `${number(+(n / size).toPrecision(2))} ${unit}`;
}

// One unit of time for a whole axis.
export function timeUnit(longest) {
  if (longest < 600) return { name: "s", size: 1 };
  if (longest < 3 * 3600) return { name: "min", size: 60 };
  if (longest < 4 * 86400) return { name: "h", size: 3600 };
  return { name: "d", size: 86400 };
}

// label: for those who hear the page
export function table(head, rows, label) {
  const t = make("table", {});
  t.append(make("thead", {}, make("tr", {}, ...head.map((h) => make("th", { scope: "col" }, h)))));
  t.append(make("tbody", {}, ...rows.map((row) => make("tr", {}, ...row.map((cell) => make("td", {}, cell instanceof Node ? cell : String(cell)))))));
  return make("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": label }, t);
}

// micro and powers as people write them
export const nice = (unit) => (unit === "1" ? "" : unit.replace(/^um/, "µm").replace("^2", "²").replace("^3", "³").replace("m2", "m²"));

// Figures with their names: [[name, value]]
export const tiles = (figures) => make("dl", { class: "tiles" }, ...figures.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))));

export const cellCounts = ({ dcm, cbm }) => [dcm > 0 ? `${dcm} deformable` : null, cbm > 0 ? `${cbm} ${cbm === 1 ? "sphere" : "spheres"}` : null].filter((p) => p).join(", ") || "none";
