// The page of the service: what runs, a form for more, and the chosen run.
import { RunPanel } from "./service_run.js";
import { fillForm, showForm } from "./service_form.js";
import { bytes, duration, make } from "./text.js";

const panel = new RunPanel(document.getElementById("run"), (id) => fillForm(document.getElementById("new"), id));
const list = document.getElementById("runs");
let listed = [];

const chosen = () => location.hash.slice(1);

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
  panel.show(listed.find((run) => run.id === chosen()) ?? null);
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
  // On a phone the run stands below the list.
  if (panel.run && panel.element.offsetLeft < 100) panel.element.scrollIntoView({ behavior: "smooth" });
});
showForm(document.getElementById("new"), (id) => { location.hash = id; });
watch();
