// The surface on which the field of a substance has one value.
import { BufferAttribute, BufferGeometry, DoubleSide, GreaterDepth, Group, LessEqualDepth, Mesh, MeshLambertMaterial } from "three";
import { magnitude } from "./colour.js";

const OPACITY = 0.6, HIDDEN_OPACITY = 0.35; // cells behind it are seen, and what is inside cells shines through
// A cube between the middles of eight blocks, corner c at (c & 1, c >> 1 & 1, c >> 2 & 1), is six tetrahedra around its
// diagonal. Those of neighbouring cubes fit, so that the surface has no holes.
const TETRAHEDRA = [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]];

// Corners of the triangles in a tetrahedron as pairs of its corners, of which one is below the level and one is not.
function trianglesIn(above) {
  const is = [0, 1, 2, 3].filter((k) => above[k]), not = [0, 1, 2, 3].filter((k) => !above[k]);
  if (is.length === 1) return [not.map((k) => [is[0], k])];
  if (is.length === 3) return [is.map((k) => [k, not[0]])];
  if (is.length !== 2) return [];
  const [a, b, c, d] = [[is[0], not[0]], [is[0], not[1]], [is[1], not[1]], [is[1], not[0]]];
  return [[a, b, c], [a, c, d]];
}

// Normals point to smaller values: {position, normal}, three numbers a corner, nine a triangle.
export function isoSurface(grid, value, level) {
  const [nx, ny, nz] = grid.n;
  const stride = [1, nx, nx * ny];
  const position = [], normal = [];
  const slope = (v, place, axis) => {
    const low = place[axis] > 0 ? v - stride[axis] : v, high = place[axis] < grid.n[axis] - 1 ? v + stride[axis] : v;
    return high > low ? (value[low] - value[high]) / (grid.spacing[axis] * ((high - low) / stride[axis])) : 0;
  };
  const vertex = (a, b) => {
    const share = (level - value[a.v]) / (value[b.v] - value[a.v]);
    const at = [], to = [];
    for (let axis = 0; axis < 3; ++axis) {
      at.push(grid.low[axis] + grid.spacing[axis] * (0.5 + a.place[axis] + share * (b.place[axis] - a.place[axis])));
      to.push((1 - share) * slope(a.v, a.place, axis) + share * slope(b.v, b.place, axis));
    }
    return { at, to };
  };
  const add = (corners) => {
    const [p, q, r] = corners.map((c) => c.at);
    const u = q.map((x, k) => x - p[k]), w = r.map((x, k) => x - p[k]);
    const face = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
    const down = corners[0].to.reduce((sum, x, k) => sum + x * face[k], 0);
    for (const c of down < 0 ? [corners[0], corners[2], corners[1]] : corners) {
      const length = Math.hypot(...c.to) || 1;
      position.push(...c.at);
      normal.push(...c.to.map((x) => x / length));
    }
  };
  for (let k = 0; k + 1 < nz; ++k)
    for (let j = 0; j + 1 < ny; ++j)
      for (let i = 0; i + 1 < nx; ++i) {
        const corner = [];
        let [some, all] = [false, true];
        for (let c = 0; c < 8; ++c) {
          const place = [i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1)];
          const v = place[0] + stride[1] * place[1] + stride[2] * place[2];
          corner.push({ v, place });
          some ||= value[v] > level;
          all &&= value[v] > level;
        }
        if (!some || all || corner.some(({ v }) => Number.isNaN(value[v]))) continue;
        for (const t of TETRAHEDRA) {
          const of = t.map((c) => corner[c]);
          for (const triangle of trianglesIn(of.map(({ v }) => value[v] > level))) add(triangle.map(([a, b]) => vertex(of[a], of[b])));
        }
      }
  return { position: new Float32Array(position), normal: new Float32Array(normal) };
}

export class FieldSurface {
  // plane: cuts it; grid: of the frames' description; null: no fields
  constructor(plane, grid) {
    this.grid = grid;
    const geometry = new BufferGeometry();
    this.parts = [[LessEqualDepth, OPACITY], [GreaterDepth, HIDDEN_OPACITY]].map(([depthFunc, opacity]) => {
      const part = new Mesh(geometry, new MeshLambertMaterial({ side: DoubleSide, transparent: true, opacity, depthFunc, depthWrite: false, clippingPlanes: [plane] }));
      part.renderOrder = 4;
      return part;
    });
    this.group = new Group().add(...this.parts);
    this.group.visible = false;
  }

  // Shows the surface of a field of a frame at a level, or nothing.
  show(frame, name, level, range) {
    const value = this.grid && name ? frame.fields?.[name] : null;
    this.group.visible = Boolean(value);
    if (!value) return;
    const { position, normal } = isoSurface(this.grid, value, level);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("normal", new BufferAttribute(normal, 3));
    this.parts[0].geometry.dispose();
    for (const part of this.parts) {
      part.geometry = geometry;
      part.material.color.setRGB(...magnitude(level, range), "srgb");
    }
  }

  // visit(x, y, z) for the corners of the box around what is shown
  forEachCorner(visit) {
    const { geometry } = this.parts[0];
    if (!this.group.visible || !geometry.getAttribute("position")?.count) return;
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    for (let k = 0; k < 8; ++k) visit(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
  }
}
