// Section faces: closed surfaces and spheres cut by a plane.
import { BufferAttribute, BufferGeometry, ShapeUtils, Vector2, Vector3 } from "three";

const CIRCLE = 64; // corners of the disc of a sphere

// Two directions within a plane, right-handed with its normal.
function directionsIn(normal) {
  const u = new Vector3(normal.y, normal.z, normal.x).cross(normal).normalize();
  return [u, new Vector3().crossVectors(normal, u)];
}

// Chains the pieces of a surface within a plane to closed loops of 2D points; open ends are left out.
// pieces: Map from mesh edge to {to: mesh edge, point}
function chain(pieces) {
  const loops = [];
  while (pieces.size > 0) {
    const first = pieces.keys().next().value;
    const loop = [];
    let at = first;
    while (pieces.has(at)) {
      const piece = pieces.get(at);
      pieces.delete(at);
      loop.push(piece.point);
      at = piece.to;
    }
    if (at === first && loop.length > 2) loops.push(loop);
  }
  return loops;
}

// Loops of every owner where a mesh crosses a plane, counter-clockwise round material.
// owner(node): key of the surface that a node belongs to
function loopsOf(point, corner, plane, flat, owner) {
  const n = point.length / 3;
  const height = new Float64Array(n);
  const { x, y, z } = plane.normal;
  // A node in the plane counts as above it, so that no triangle has a corner in the plane.
  for (let k = 0; k < n; ++k) height[k] = x * point[3 * k] + y * point[3 * k + 1] + z * point[3 * k + 2] + plane.constant || 1e-12;
  const p = new Vector3();
  const cross = (a, b) => {
    const [i, j] = a < b ? [a, b] : [b, a]; // the same point from both triangles
    const t = height[i] / (height[i] - height[j]);
    for (let axis = 0; axis < 3; ++axis) p.setComponent(axis, point[3 * i + axis] + t * (point[3 * j + axis] - point[3 * i + axis]));
    return flat(p);
  };
  const edge = (a, b) => (a < b ? a * n + b : b * n + a);
  const found = new Map();
  for (let t = 0; t < corner.length; t += 3) {
    let [a, b, c] = [corner[t], corner[t + 1], corner[t + 2]];
    const above = (height[a] > 0) + (height[b] > 0) + (height[c] > 0);
    if (above === 0 || above === 3) continue;
    // Turned until a is alone on its side.
    while (height[a] > 0 === height[b] > 0 || height[a] > 0 === height[c] > 0) [a, b, c] = [b, c, a];
    const [from, to] = height[a] > 0 ? [[a, b], [c, a]] : [[c, a], [a, b]];
    const key = owner(a);
    if (!found.has(key)) found.set(key, new Map());
    found.get(key).set(edge(...from), { to: edge(...to), point: cross(...from) });
  }
  return new Map([...found].map(([key, pieces]) => [key, chain(pieces)]));
}

function contains(loop, p) {
  let inside = false;
  for (let i = 0, j = loop.length - 1; i < loop.length; j = i++) {
    const [a, b] = [loop[i], loop[j]];
    if (a.y > p.y !== b.y > p.y && p.x < ((b.x - a.x) * (p.y - a.y)) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

// Outlines with their holes.
function facesOf(loops) {
  const sorted = loops.map((loop) => ({ loop, area: Math.abs(ShapeUtils.area(loop)) })).sort((a, b) => b.area - a.area);
  const faces = [];
  for (const { loop } of sorted) {
    const depth = sorted.filter((s) => s.loop !== loop && contains(s.loop, loop[0])).length;
    if (depth % 2 === 0) faces.push({ outline: loop, holes: [] });
    else faces.findLast((f) => contains(f.outline, loop[0]))?.holes.push(loop);
  }
  return faces;
}

// Discs of spheres, those that overlap parted along the line in which their surfaces meet.
function discsOf({ center, radius, id }, plane, flat) {
  const discs = [];
  const c = new Vector3();
  for (let k = 0; k < id.length; ++k) {
    c.fromArray(center, 3 * k);
    const d = plane.distanceToPoint(c);
    const squared = radius[k] ** 2 - d * d;
    if (squared > 0) discs.push({ at: flat(c), r: Math.sqrt(squared), squared, id: id[k] });
  }
  return discs.map((disc) => {
    let outline = Array.from({ length: CIRCLE }, (_, k) => {
      const angle = (2 * Math.PI * k) / CIRCLE;
      return new Vector2(disc.at.x + disc.r * Math.cos(angle), disc.at.y + disc.r * Math.sin(angle));
    });
    for (const other of discs) {
      const to = other.at.clone().sub(disc.at);
      const distance = to.length();
      if (other === disc || distance >= disc.r + other.r || distance === 0) continue;
      const reach = (distance * distance + disc.squared - other.squared) / (2 * distance);
      to.divideScalar(distance);
      outline = clip(outline, (p) => reach - (p.x - disc.at.x) * to.x - (p.y - disc.at.y) * to.y);
    }
    return { id: disc.id, outline };
  }).filter((d) => d.outline.length > 2);
}

// The part of a convex polygon where a linear function is positive.
export function clip(polygon, depth) {
  const kept = [];
  polygon.forEach((p, k) => {
    const q = polygon[(k + 1) % polygon.length];
    const [a, b] = [depth(p), depth(q)];
    if (a >= 0) kept.push(p);
    if (a >= 0 !== b >= 0) kept.push(p.clone().lerp(q, a / (a - b)));
  });
  return kept;
}

// Number of the connected part that each node of a mesh belongs to, kept with the mesh.
function partsOf(mesh) {
  if (mesh.part) return mesh.part;
  const part = Int32Array.from({ length: mesh.point.length / 3 }, (_, k) => k);
  const root = (k) => {
    while (part[k] !== k) k = part[k] = part[part[k]];
    return k;
  };
  for (let t = 0; t < mesh.corner.length; t += 3) for (const k of [1, 2]) part[root(mesh.corner[t + k])] = root(mesh.corner[t]);
  return (mesh.part = part.map((_, k) => root(k)));
}

// Triangles and outlines of all faces: {geometry, lines, owner: [triangle] {id, kind}}.
// Kinds: 0 cell, 1 sphere, 2 obstacle, 3 nucleus.
export function makeSection(frame, plane, shown) {
  const normal = plane.normal.clone().negate(); // towards the eye that looks at the cut
  const [u, v] = directionsIn(normal);
  const origin = plane.coplanarPoint(new Vector3());
  const flat = (p) => new Vector2(p.dot(u) - origin.dot(u), p.dot(v) - origin.dot(v));
  const triangles = [], lines = [], owner = [];
  const lift = (p) => [0, 1, 2].map((a) => origin.getComponent(a) + p.x * u.getComponent(a) + p.y * v.getComponent(a));
  const add = (outline, holes, who) => {
    const all = [...outline, ...holes.flat()];
    for (const face of ShapeUtils.triangulateShape(outline, holes)) {
      for (const k of face) triangles.push(...lift(all[k]));
      owner.push(who);
    }
    for (const loop of [outline, ...holes]) loop.forEach((p, k) => lines.push(...lift(p), ...lift(loop[(k + 1) % loop.length])));
  };
  // Later faces lie over earlier ones.
  if (shown.still && frame.still.corner.length > 0)
    for (const loops of loopsOf(frame.still.point, frame.still.corner, plane, flat, (node) => partsOf(frame.still)[node]).values())
      for (const { outline, holes } of facesOf(loops)) add(outline, holes, { id: -1, kind: 2 });
  if (shown.spheres) for (const { id, outline } of discsOf(frame.sphere, plane, flat)) add(outline, [], { id, kind: 1 });
  if (shown.cells) {
    const { corner, cell, kind } = frame.mesh;
    const loops = loopsOf(frame.point, corner, plane, flat, (node) => `${kind[node]} ${cell[node]}`);
    for (const nucleus of [false, true])
      for (const [key, of] of loops) {
        const [k, id] = key.split(" ").map(Number);
        if ((k === 3) === nucleus) for (const { outline, holes } of facesOf(of)) add(outline, holes, { id, kind: k });
      }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(triangles), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(triangles.length), 3));
  const outlines = new BufferGeometry();
  outlines.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
  return { geometry, lines: outlines, owner };
}
