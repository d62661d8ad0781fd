// The start of a scene in 3D. The page of the service loads this script when it is first asked for.
import { CellPanel } from "./cell.js";
import { openFrames } from "./data.js";
import { Viewer } from "./viewer.js";

let viewer = null;

// start: the reply to POST /preview
window.acinusPreview = async (place, start) => {
  viewer?.end();
  const shown = [{ name: start.name, raw: start.frames, frames: openFrames(start.frames), scene: start.scene, walls: start.walls }];
  const panel = new CellPanel(shown);
  viewer = new Viewer(shown, (run, id, frame, field) => panel.show(run, id, frame, field));
  place.replaceChildren(viewer.element, panel.element);
  await viewer.start();
};
