// Walls given by a formula: planes as polygons within the box of the tissue, the capsule as a sphere.
import {
  BufferAttribute, BufferGeometry, DoubleSide, Group, LineBasicMaterial, LineLoop, Mesh, MeshBasicMaterial, ShapeUtils, SphereGeometry, Vector2, Vector3,
} from "three";
import { clip } from "./section.js";

const SAME_TIME = 1e-6; // s; a wall still stands in the frame at which it opens
const MARGIN = 0.12; // of the box, by which planes reach beyond it

export const WALL_COLOUR = 0x5d7891;

const stands = (wall, time) => wall.opens == null || time <= wall.opens + SAME_TIME;

function pointAt(wall, time) {
  const moved = Math.sign(wall.speed) * Math.min(Math.abs(wall.speed) * Math.max(time, 0), wall.travel);
  return new Vector3(...wall.point).addScaledVector(new Vector3(...wall.normal).normalize(), moved);
}

// Corners of the part of a plane that lies in a box and on the inner side of the other planes.
function polygonOf(wall, others, time, [low, high]) {
  const normal = new Vector3(...wall.normal).normalize();
  const u = (Math.abs(normal.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).cross(normal).normalize();
  const v = new Vector3().crossVectors(normal, u);
  const middle = low.clone().add(high).multiplyScalar(0.5);
  const size = low.distanceTo(high);
  const origin = middle.addScaledVector(normal, pointAt(wall, time).sub(middle).dot(normal));
  const space = (p) => origin.clone().addScaledVector(u, p.x).addScaledVector(v, p.y);
  let polygon = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => new Vector2(a * size, b * size));
  for (let axis = 0; axis < 3; ++axis) {
    polygon = clip(polygon, (p) => space(p).getComponent(axis) - low.getComponent(axis));
    polygon = clip(polygon, (p) => high.getComponent(axis) - space(p).getComponent(axis));
  }
  for (const other of others) {
    const at = pointAt(other, time);
    const inner = new Vector3(...other.normal).normalize();
    if (Math.abs(inner.dot(normal)) < 0.999) polygon = clip(polygon, (p) => space(p).sub(at).dot(inner) + 1e-6 * size);
  }
  return { flat: polygon, corners: polygon.map(space) };
}

// The walls that stand at a time, as three.js objects. Mirror planes are outlines only: nothing material is there.
// box: [low, high] of all else
export function drawWalls(walls, time, box) {
  const group = new Group();
  const margin = Math.max(1, MARGIN * box[0].distanceTo(box[1]));
  const wide = [box[0].clone().subScalar(margin), box[1].clone().addScalar(margin)];
  const standing = walls.filter((w) => stands(w, time));
  const planes = standing.filter((w) => w.kind === "plane");
  for (const wall of standing) {
    if (wall.kind === "capsule") {
      const ball = new Mesh(new SphereGeometry(Math.max(wall.min_radius, wall.radius - wall.speed * Math.max(time, 0)), 48, 32), glass());
      ball.position.set(...wall.point);
      group.add(ball);
      continue;
    }
    const { flat, corners } = polygonOf(wall, planes.filter((w) => w !== wall), time, wide);
    if (corners.length < 3) continue;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flatMap((c) => c.toArray())), 3));
    group.add(new LineLoop(geometry, new LineBasicMaterial({ color: WALL_COLOUR, transparent: true, opacity: wall.mirror ? 0.45 : 0.9 })));
    if (wall.mirror) continue;
    const face = geometry.clone();
    face.setIndex(ShapeUtils.triangulateShape(flat, []).flat());
    group.add(new Mesh(face, glass()));
  }
  return group;
}

const glass = () => new MeshBasicMaterial({ color: WALL_COLOUR, transparent: true, opacity: 0.22, side: DoubleSide, depthWrite: false });

export function disposeOf(group) {
  group.traverse((o) => { o.geometry?.dispose(); o.material?.dispose(); });
}
