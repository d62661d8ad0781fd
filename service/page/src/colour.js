// Fields of cells and their colours.
import { nice } from "./text.js";

// viridis, sampled; magnitudes stay readable for colour-blind eyes and in print.
const VIRIDIS = [
  [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37],
];
const CLASSES = [
  [214, 122, 94], [96, 139, 193], [128, 171, 92], [171, 124, 179], [222, 178, 80], [99, 177, 170],
];


// A colour that neither a class nor a magnitude has.
export const SELECTED = [255, 20, 200];

// Hues far apart for neighbouring ids.
function colourOfCell(id) {
  const hue = (id * 0.61803398875) % 1, light = 0.52 + 0.12 * ((id * 0.41421356) % 1);
  const channel = (shift) => {
    const k = (shift + 12 * hue) % 12;
    return light - 0.55 * Math.min(light, 1 - light) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  };
  return [channel(0), channel(8), channel(4)];
}

// What can be shown: label, unit and scale from the run file's units.
export const FIELDS = {
  model: { label: "Model", classes: ["deformable cell", "sphere"], of: (t, r) => t.kind[r] },
  cell: { label: "Cell", each: true, of: (t, r) => t.id[r] },
  pressure: { label: "Contact pressure", unit: "Pa", scale: 1000 },
  cytosol_pressure: { label: "Cytosol pressure", unit: "Pa", scale: 1000 },
  compression: {
    label: "Relative volume V/V₀", unit: "",
    of: (t, r) => t.volume[r] / ((4 / 3) * Math.PI * t.radius[r] ** 3),
  },
  volume: { label: "Volume", unit: "µm³" },
  contact_force: { label: "Contact force", unit: "nN" },
  normal_force: { label: "Normal force", unit: "nN" },
  contact_area: { label: "Contact area", unit: "µm²" },
  contacts: { label: "Neighbours in contact", unit: "" },
  migration_force: { label: "Active force", unit: "nN" },
  radius: { label: "Radius", unit: "µm" },
  type: { label: "Cell type", classes: [] },
  leader: { label: "Leading cells", classes: ["other cell", "leading cell"] },
};

// Adds the concentrations of substances, which have the names of a scene.
function addSubstances(frames) {
  for (const column of frames.columns) {
    const [, kind, name] = column.match(/^(concentration|exchange)_(.+)$/) ?? [];
    if (!kind || FIELDS[column]) continue;
    const label = kind === "exchange" ? `Secretion minus uptake: ${name}` : `Concentration: ${name}`;
    FIELDS[column] = { label, unit: nice(frames.units[column] ?? "") };
  }
}

export function availableFields(frames) {
  addSubstances(frames);
  const has = new Set([...frames.id_columns, ...frames.columns]);
  return Object.keys(FIELDS).filter((name) => {
    if (name === "model") return has.has("kind");
    if (name === "cell") return has.has("id");
    if (name === "compression") return has.has("volume") && has.has("radius");
    return has.has(name);
  });
}

export function valueOf(name, table, row) {
  const field = FIELDS[name];
  const value = field.of ? field.of(table, row) : table[name][row];
  return value * (field.scale ?? 1);
}

// Range that leaves out the outermost 2 % of all values, so that one outlier does not flatten the colours.
export function rangeOf(name, frames) {
  const values = [];
  for (const f of frames) for (const row of f.row.values()) values.push(valueOf(name, f.table, row));
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  if (sorted.length === 0) return [0, 1];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const [low, high] = [at(0.02), at(0.98)];
  return high > low ? [low, high] : [low - 0.5 * (Math.abs(low) || 1), low + 0.5 * (Math.abs(low) || 1)];
}

export function magnitude(value, [low, high]) {
  const share = high > low ? (value - low) / (high - low) : 0.5;
  const x = Math.min(1, Math.max(0, share)) * (VIRIDIS.length - 1);
  const k = Math.min(VIRIDIS.length - 2, Math.floor(x));
  return VIRIDIS[k].map((c, a) => (c + (x - k) * (VIRIDIS[k + 1][a] - c)) / 255);
}

export function colourOf(name, value, [low, high]) {
  if (!Number.isFinite(value)) return [0.6, 0.6, 0.6];
  if (FIELDS[name].each) return colourOfCell(value);
  if (FIELDS[name].classes) return CLASSES[((value % CLASSES.length) + CLASSES.length) % CLASSES.length].map((c) => c / 255);
  return magnitude(value, [low, high]);
}

export const gradient = () => `linear-gradient(to right, ${VIRIDIS.map((c) => `rgb(${c})`).join(", ")})`;
export const classColour = (k) => `rgb(${CLASSES[k % CLASSES.length]})`;
