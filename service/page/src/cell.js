// One cell: its row in the frame shown, its relatives, its history.
import { FIELDS, valueOf } from "./colour.js";
import { nameOf, shownIn } from "./names.js";
import { plot } from "./plots.js";
import { make, nice, number, table } from "./text.js";

export class CellPanel {
  constructor(runs) {
    this.runs = runs;
    this.element = make("div", { class: "cell", "aria-live": "polite", hidden: true });
  }

  async show(run, id, frame, field) {
    this.element.hidden = id == null;
    if (id == null) return;
    const { frames, raw, name } = this.runs[run];
    const { table: rows, row } = frame;
    const at = row.get(id);
    const wanted = (this.wanted = `${run} ${id} ${field}`);
    const all = await Promise.all(frames.times.map((_, k) => frames.frame(k)));
    if (this.wanted !== wanted) return;
    const seen = all.filter((f) => f.row.has(id));
    const curve = { label: `cell ${id}`, time: seen.map((f) => f.time), value: seen.map((f) => valueOf(field, f.table, f.row.get(id))), points: true };
    const head = make("h3", {}, `Cell ${id}`, this.runs.length > 1 ? make("span", { class: "unit" }, ` of ${name}`) : null);
    const values = at == null ? [] : [...raw.id_columns, ...raw.columns].filter((c) => c !== "id" && c !== "parent").map((c) => {
      if (c === "kind") return ["Model", FIELDS.model.classes[rows.kind[at]]];
      if (c === "leader") return ["Leading cell", rows.leader[at] ? "yes" : "no"];
      const [factor, unit] = shownIn(raw.units[c]);
      return [FIELDS[c]?.label ?? nameOf(c), `${number(rows[c][at] * factor)} ${nice(unit)}`];
    });
    this.element.replaceChildren(head, make("p", { class: "quiet" }, this.relatives(id, all)),
      at == null ? make("p", {}, "Not present in this frame.") : table(["", "in this frame"], values, `Cell ${id}`),
      (FIELDS[field].each || FIELDS[field].classes ? null : plot(FIELDS[field].label, FIELDS[field].unit ?? "", [curve])) ?? "");
  }

  relatives(id, all) {
    const mother = new Map();
    for (const f of all) f.table.id?.forEach((cell, k) => mother.set(cell, f.table.parent?.[k] ?? -1));
    const line = [];
    for (let m = mother.get(id); m != null && m >= 0 && line.length < 20; m = mother.get(m)) line.push(m);
    const daughters = [...mother].filter(([, m]) => m === id).map(([cell]) => cell);
    const parts = [line.length > 0 ? `mother ${line.join(" ← ")}` : "founder"];
    if (daughters.length > 0) parts.push(`daughters ${daughters.join(", ")}`);
    return parts.join("; ");
  }
}
