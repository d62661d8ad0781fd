// The start of what the form asks for, drawn before anything runs.
import { cellCounts, duration, make, number } from "./text.js";

let drawing = null; // the script that draws, once it is asked for

function loadDrawing() {
  drawing ??= new Promise((done, failed) => document.head.append(make("script", { src: "/page/preview.js", onload: done, onerror: () => failed(new Error("the 3D view cannot be loaded")) })));
  return drawing;
}

const lines = (texts, kind) => (texts.length > 0 ? make("ul", { class: kind }, ...texts.map((t) => make("li", {}, t))) : null);

export class PreviewPanel {
  // readForm(): what the form asks for
  constructor(element, readForm) {
    this.element = element;
    this.readForm = readForm;
    this.asked = 0;
    this.tell("Preview, in the form, draws the start of its scene here.");
  }

  tell(text, kind = "hint") {
    this.element.replaceChildren(make("section", {}, make("h2", {}, "Preview"), make("pre", { class: kind, role: kind === "fault" ? "alert" : "status" }, text)));
  }

  async show() {
    const turn = ++this.asked;
    this.tell("Placing the cells …");
    try {
      const answer = await fetch("/preview", { method: "POST", body: JSON.stringify(await this.readForm()) });
      const start = await answer.json();
      if (!answer.ok) throw new Error(start.error.message);
      await loadDrawing();
      if (turn === this.asked) await this.draw(start);
    } catch (error) {
      if (turn === this.asked) this.tell(error.message, "fault");
    }
    this.element.dataset.ready = String(turn);
  }

  async draw(start) {
    const place = make("div", { class: "view start" });
    const facts = [["cells", cellCounts(start.cells)], ["vessels", start.vessel_length_um > 0 ? `${number(start.vessel_length_um)} µm` : "none"],
      ["walls", start.walls.length > 0 ? start.walls.map((w) => w.name).join(", ") : "none"], ["ends at", duration(start.end_s)]];
    if (start.start_up) facts.push(["start-up", "grows these cells from small ones before t = 0; here they have full size at their first places"]);
    this.element.replaceChildren(
      make("section", {}, make("div", { class: "headline" }, make("h2", {}, start.name), make("span", { class: "badge" }, "preview")),
        make("dl", { class: "facts" }, ...facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)])), lines(start.warnings, "warnings"), lines(start.notes, "quiet")),
      make("section", {}, place));
    await window.acinusPreview(place, start);
  }
}
