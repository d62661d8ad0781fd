// Two runs side by side: the report of both with their comparison.
import { make } from "./text.js";

// ids: of the two runs; named(id): a run's name
export function showComparison(element, ids, named) {
  const url = `/compare/${ids[0]}/${ids[1]}`;
  if (element.dataset.shown === url) return;
  element.dataset.shown = url;
  const back = ids.map((id) => make("a", { href: `#${id}` }, named(id)));
  // Its page stands in a frame of its own, which reaches nothing else.
  const frame = make("iframe", { src: url, title: "Comparison of the runs", sandbox: "allow-scripts allow-downloads" });
  element.replaceChildren(make("section", {}, make("div", { class: "headline" }, make("h2", {}, "Comparison"), make("span", {}, back[0], " and ", back[1])),
    make("div", { class: "actions" }, make("a", { href: url, target: "_blank", rel: "noopener" }, "Open in a page of its own"))), make("section", {}, frame));
}
