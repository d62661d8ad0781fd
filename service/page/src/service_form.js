// The form that asks for a run.
import { make } from "./text.js";

const OWN = "(your own)";

// "time.end = 2 h" a line; a value that is JSON is taken as such
function readChanges(text) {
  const set = {};
  for (const line of text.split("\n").map((l) => l.trim()).filter((l) => l)) {
    const at = line.indexOf("=");
    if (at < 1) throw new Error(`"${line}": a change is KEY = VALUE`);
    const value = line.slice(at + 1).trim();
    try { set[line.slice(0, at).trim()] = JSON.parse(value); } catch { set[line.slice(0, at).trim()] = value; }
  }
  return set;
}

export const changesOf = (form) => readChanges(form.querySelector("#set").value);

// A text that reads as another value of JSON ("7", "true") keeps its quotes.
function written(value) {
  if (typeof value !== "string") return JSON.stringify(value);
  try { JSON.parse(value); return JSON.stringify(value); } catch { return value; }
}

export function setChanges(form, set) {
  form.querySelector("#set").value = Object.entries(set).map(([key, value]) => `${key} = ${written(value)}`).join("\n");
}

async function inBase64(file) {
  const url = await new Promise((done, failed) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.onerror = () => failed(new Error(`${file.name} cannot be read`));
    reader.readAsDataURL(file);
  });
  return url.slice(url.indexOf(",") + 1);
}

// Scenes may hold comments, which JSON of browsers may not.
const withoutComments = (text) => text.replace(/("(?:\\.|[^"\\])*")|\/\/[^\n]*|\/\*[\s\S]*?\*\//g, (_, string) => string ?? "");

export async function readForm(form) {
  const value = (id) => form.querySelector("#" + id).value;
  const asked = { set: readChanges(value("set")) };
  if (value("name").trim()) asked.name = value("name").trim();
  if (value("scene") !== OWN) return { ...asked, scene: value("scene") };
  const [own] = form.querySelector("#own").files;
  if (!own) throw new Error("choose the file of your scene");
  try { asked.scene = JSON.parse(withoutComments(await own.text())); } catch (error) { throw new Error(`${own.name}: ${error.message}`); }
  asked.files = {};
  for (const file of form.querySelector("#files").files) asked.files[file.name] = await inBase64(file);
  return asked;
}

// Fills the form with what a run of a shipped scene was started from.
export async function fillForm(form, id) {
  const answer = await fetch(`/runs/${id}`); // lists of runs shorten long changes
  if (!answer.ok) return;
  const run = await answer.json();
  const put = (field, value) => { form.querySelector("#" + field).value = value; };
  put("scene", run.scene);
  put("set", run.set.join("\n"));
  put("name", run.name);
  form.querySelector("#scene").dispatchEvent(new Event("change"));
  form.scrollIntoView({ behavior: "smooth", block: "nearest" });
  form.querySelector("#set").focus();
}

// Fills the list of scenes. started(id), preview(), parameters(), sceneChanged(): answers to what is done in the form
export function showForm(form, { started, preview, parameters, sceneChanged }) {
  const scene = form.querySelector("#scene"), fault = form.querySelector("#fault"), button = form.querySelector("button");
  const about = new Map([[OWN, "A scene file of yours. It may extend a shipped scene."]]);
  const shown = () => {
    form.querySelector("#about").textContent = about.get(scene.value) ?? "";
    for (const element of form.querySelectorAll(".own")) element.hidden = scene.value !== OWN;
  };
  scene.addEventListener("change", () => { shown(); sceneChanged(); });
  form.querySelector("#own").addEventListener("change", sceneChanged);
  form.querySelector("#set").addEventListener("change", sceneChanged);
  form.querySelector("#ask-preview").addEventListener("click", preview);
  form.querySelector("#ask-parameters").addEventListener("click", parameters);
  const filled = fetch("/scenes").then((answer) => answer.json()).then((scenes) => {
    for (const s of scenes) about.set(s.name, s.description);
    scene.replaceChildren(...[...scenes.map((s) => s.name), OWN].map((name) => make("option", { value: name }, name)));
    scene.value = scenes.some((s) => s.name === "lobule_hybrid") ? "lobule_hybrid" : scene.value;
    shown();
  });
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    button.disabled = true;
    fault.hidden = true;
    try {
      const answer = await fetch("/runs", { method: "POST", body: JSON.stringify(await readForm(form)) });
      const said = await answer.json();
      if (!answer.ok) throw new Error(said.error.message);
      started(said.id);
    } catch (error) {
      fault.textContent = error.message;
      fault.hidden = false;
    }
    button.disabled = false;
  });
  return filled;
}
