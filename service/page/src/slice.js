// A slice of the field of a substance, in the plane of the cut.
import { BufferAttribute, BufferGeometry, DataTexture, DoubleSide, LinearFilter, Mesh, MeshBasicMaterial, RGBAFormat, SRGBColorSpace } from "three";
import { magnitude } from "./colour.js";

const OPEN_ENDING = "_open"; // fields of open fractions beside those of substances that are kept out of cells

export const labelOf = (name) => (name.endsWith(OPEN_ENDING) ? `${name.slice(0, -OPEN_ENDING.length)}: open fraction` : name);

// Smallest and largest value of a field in all frames.
export function extremesOf(name, frames) {
  let [low, high] = [Infinity, -Infinity];
  for (const f of frames) {
    for (const v of f.fields?.[name] ?? []) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

// Values in a plane across an axis, linear between the middles of blocks: {value, wide, high}.
function layerOf(grid, value, axis, at) {
  const [u, v] = [0, 1, 2].filter((a) => a !== axis);
  const stride = [1, grid.n[0], grid.n[0] * grid.n[1]];
  const place = Math.min(Math.max((at - grid.low[axis]) / grid.spacing[axis] - 0.5, 0), grid.n[axis] - 1);
  const below = Math.min(Math.floor(place), grid.n[axis] - 1), above = Math.min(below + 1, grid.n[axis] - 1), share = place - below;
  const [wide, high] = [grid.n[u], grid.n[v]];
  const out = new Float32Array(wide * high);
  for (let j = 0; j < high; ++j)
    for (let i = 0; i < wide; ++i) {
      const start = i * stride[u] + j * stride[v];
      out[j * wide + i] = (1 - share) * value[start + below * stride[axis]] + share * value[start + above * stride[axis]];
    }
  return { value: out, wide, high };
}

function textureOf(grid, fields, name, axis, at, range) {
  const { value, wide, high } = layerOf(grid, fields[name], axis, at);
  const pixels = new Uint8Array(4 * wide * high);
  value.forEach((c, k) => {
    magnitude(c, range).forEach((part, channel) => { pixels[4 * k + channel] = Math.round(255 * part); });
    pixels[4 * k + 3] = 255;
  });
  const texture = new DataTexture(pixels, wide, high, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

// The rectangle of the box in the plane; its edges are those of the outer voxels.
function rectangleOf(grid, axis, at) {
  const [u, v] = [0, 1, 2].filter((a) => a !== axis);
  const position = [], uv = [];
  for (const [i, j] of [[0, 0], [1, 0], [1, 1], [0, 1]]) {
    const p = [0, 0, 0];
    p[axis] = at;
    p[u] = grid.low[u] + i * grid.size[u];
    p[v] = grid.low[v] + j * grid.size[v];
    position.push(...p);
    uv.push((i * grid.size[u]) / (grid.spacing[u] * grid.n[u]), (j * grid.size[v]) / (grid.spacing[v] * grid.n[v]));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(uv), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return geometry;
}

export class FieldSlice {
  // grid: of the frames' description; null: no fields
  constructor(grid) {
    this.grid = grid;
    this.mesh = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ side: DoubleSide, depthWrite: false }));
    this.mesh.visible = false;
    this.chosen = false;
  }

  // Shows a field of a frame in the plane across an axis at a place (um), or nothing.
  show(frame, name, axis, at, range) {
    const { grid, mesh } = this;
    this.chosen = Boolean(grid && name);
    const within = grid && axis >= 0 && at >= grid.low[axis] && at <= grid.low[axis] + grid.size[axis];
    mesh.visible = Boolean(within && frame.fields?.[name]);
    mesh.material.map?.dispose();
    mesh.material.map = null;
    if (!mesh.visible) return;
    mesh.geometry.dispose();
    mesh.geometry = rectangleOf(grid, axis, at);
    mesh.material.map = textureOf(grid, frame.fields, name, axis, at, range);
    mesh.material.needsUpdate = true;
  }

  // visit(x, y, z) for the corners of the box of the fields, while one is chosen
  forEachCorner(visit) {
    if (!this.chosen) return;
    const { low, size } = this.grid;
    for (let k = 0; k < 8; ++k) visit(...low.map((x, a) => x + ((k >> a) & 1) * size[a]));
  }
}
