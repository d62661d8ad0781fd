// The keys of a scene from its JSON Schema, as rows of a form.

const isBlock = (schema) => schema?.properties != null;

// Block among the forms of a key; null without one.
const blockOf = (schema) => (isBlock(schema) || schema?.additionalProperties?.type === "object" ? schema : schema?.anyOf?.find(blockOf)) ?? null;

// Leaf among the forms of a key that says most: one with a dimension, choices or numbers.
const leafOf = (schema) => (schema.anyOf ? { ...(schema.anyOf.find((s) => s.$comment || s.enum || s.type === "number" || s.type === "integer") ?? {}), ...schema } : schema);

// "simulated time after t = 0. Range: > 0 h. Paper: dt" in its parts
function partsOf(description = "") {
  const [, what, limits = "", paper = ""] = description.match(/^([\s\S]*?)(?:\.? Range: ([\s\S]*?))?(?:\.? Paper: ([\s\S]*))?$/);
  const [, range, more = ""] = limits.match(/^([^"]*?)(?:\. (".*))?$/s); // "> 0 h. "auto": these cells do not grow"
  return { meaning: more ? `${what}. ${more}` : what, range, paper };
}

function rangeOf(schema) {
  const { minimum: low, maximum: high, exclusiveMinimum: above, exclusiveMaximum: below } = schema;
  const parts = [low != null ? `>= ${low}` : above != null ? `> ${above}` : null, high != null ? `<= ${high}` : below != null ? `< ${below}` : null];
  return parts.filter((p) => p).join(", ");
}

const unitOf = (text) => (typeof text === "string" ? text.match(/^ *[+-]?[\d.]+(?:e[+-]?\d+)? +(\D.*)$/i)?.[1] ?? null : null);

function describe(schema, value) {
  const leaf = leafOf(schema), item = leaf.items ?? {};
  const { meaning, range, paper } = partsOf(schema.description);
  const dimension = leaf.$comment ?? item.$comment ?? "";
  const unit = [value, schema.default, leaf.examples?.[0], item.examples?.[0]].flat().map(unitOf).find((u) => u) ?? "";
  return { meaning, paper, range: range || rangeOf(leaf), unit, dimension, choices: leaf.enum ?? (leaf.type === "boolean" ? [true, false] : null), isText: leaf.type === "string" };
}

// Rows of all keys: {path, group, value, inScene, meaning, range, unit, ...}. base: the scene with every default.
export function rowsOf(schema, base, path = [], inScene = true) {
  const rows = [];
  const add = (name, inner, value, present) => {
    const below = [...path, name], block = blockOf(inner);
    const isList = Array.isArray(value) || (inner.type === "array");
    if (block && !isList && !(present && value != null && typeof value !== "object")) rows.push(...rowsOf(block, value ?? {}, below, present && value != null));
    else rows.push({ path: below.join("."), group: below.length > 1 ? below.slice(0, below[0] === "cell_types" ? 2 : 1).join(".") : "scene", value, inScene: present && value !== undefined, fallback: inner.default, ...describe(inner, value) });
  };
  for (const [name, inner] of Object.entries(schema.properties ?? {})) if (!(path.length === 0 && ["extends", "$schema"].includes(name))) add(name, inner, base[name], inScene);
  if (typeof schema.additionalProperties === "object") for (const [name, value] of Object.entries(base)) if (!schema.properties?.[name]) add(name, schema.additionalProperties, value, inScene);
  return rows;
}

export const textOf = (value) => (value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value));

// What a field holds as a value of its key.
export function valueOf(row, text) {
  if (row.isText && typeof row.value !== "object") return text;
  try { return JSON.parse(text); } catch { return text; }
}

// Faults of a message by key: {faults: Map of path to texts, rest: lines about no key}. paths: of all rows.
export function sortFaults(message, paths) {
  const faults = new Map(), rest = [];
  for (const line of message.split("\n").filter((l) => l.trim())) {
    const found = line.match(/(?:^|\s)\/([\w-]+(?:\/[\w-]+)*)(?= = |:)/);
    let path = found?.[1].replaceAll("/", ".") ?? "";
    while (path && !paths.has(path)) path = path.includes(".") ? path.slice(0, path.lastIndexOf(".")) : "";
    if (path) faults.set(path, [...(faults.get(path) ?? []), line.slice(found.index).trim()]);
    else rest.push(line);
  }
  return { faults, rest };
}
