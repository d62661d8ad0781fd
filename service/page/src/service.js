// The page of the service: what runs, a form for more, and the chosen run.
import { RunPanel } from "./service_run.js";
import { showComparison } from "./service_compare.js";
import { changesOf, fillForm, readForm, setChanges, showForm } from "./service_form.js";
import { ParametersPanel } from "./service_parameters.js";
import { PreviewPanel } from "./service_preview.js";
import { bytes, duration, make } from "./text.js";

const form = document.getElementById("new");
const panel = new RunPanel(document.getElementById("run"), (id) => fillForm(form, id));
const list = document.getElementById("runs");
let listed = [];

const chosen = () => location.hash.slice(1);
const articles = Object.fromEntries(["run", "parameters", "preview", "compare"].map((id) => [id, document.getElementById(id)]));
const preview = new PreviewPanel(articles.preview, () => readForm(form));
const parameters = new ParametersPanel(articles.parameters, { read: () => readForm(form), changes: () => changesOf(form), setChanges: (set) => setChanges(form, set) },
  { preview: () => go("preview"), start: () => form.requestSubmit() });

// Shows a page again even if it is shown already.
function go(where) {
  if (chosen() === where) showPage();
  else location.hash = where;
}

// The article that the address names; a run's by default.
function showPage() {
  const [page, ...ids] = chosen().split("/"), named = articles[page] && page !== "run" ? page : "run";
  for (const [id, article] of Object.entries(articles)) article.hidden = id !== named;
  if (named === "parameters") parameters.open();
  if (named === "preview") preview.show();
  if (named === "compare" && ids.length === 2) showComparison(articles.compare, ids, (id) => listed.find((run) => run.id === id)?.name ?? id);
  // On a phone the article stands below the list.
  if ((named !== "run" || panel.run) && articles[named].offsetLeft < 100) articles[named].scrollIntoView({ behavior: "smooth" });
}

function progress(run) {
  const cells = run.cells.dcm + run.cells.cbm;
  if (run.state === "running" && run.phase !== "running") return run.phase || "starting";
  if (run.state === "running") return `${duration(run.time_s)} of ${duration(run.end_s)}, ${cells} cells${run.left_s == null ? "" : `, ${duration(run.left_s)} left`}`;
  if (run.cause) return run.cause;
  return run.state === "completed" ? `${duration(run.time_s)}, ${cells} cells` : run.created;
}

function entry(run) {
  const link = make("a", { href: "#" + run.id, "aria-current": run.id === chosen() ? "page" : null },
    make("span", { class: "title" }, run.name), make("span", { class: "badge " + run.state }, run.state), make("span", { class: "progress" }, progress(run)));
  if (run.state === "running" && run.end_s > 0) link.append(make("progress", { max: "1", value: String(Math.max(0, run.time_s) / run.end_s), "aria-label": "simulated" }));
  return make("li", {}, link);
}

function show() {
  // What has the focus keeps it: the list is made anew every second.
  const focused = list.contains(document.activeElement) ? document.activeElement.getAttribute("href") : null;
  list.replaceChildren(...listed.map(entry));
  if (listed.length === 0) list.append(make("li", { class: "hint" }, "None yet."));
  if (focused) list.querySelector(`a[href="${focused}"]`)?.focus();
  panel.show(listed.find((run) => run.id === chosen()) ?? null, listed);
}

function watch() {
  const counts = document.getElementById("counts");
  const source = new EventSource("/events");
  source.onmessage = (message) => {
    const news = JSON.parse(message.data);
    listed = news.runs;
    counts.textContent = Object.entries(news.count).map(([state, n]) => `${n} ${state}`).join(", ");
    document.querySelector("footer").textContent = `acinus ${news.version}, ${bytes(news.disk_bytes)} on disk. The queue is kept when the service ends.`;
    show();
    document.body.dataset.ready = "yes";
  };
  source.onerror = () => { counts.textContent = "no reply from the service; trying again"; };
}

addEventListener("hashchange", () => {
  show();
  showPage();
});
showForm(form, { started: (id) => { location.hash = id; }, preview: () => go("preview"), parameters: () => go("parameters"), sceneChanged: () => { if (chosen() === "parameters") parameters.open(); } })
  .then(() => { if (chosen()) showPage(); });
watch();
