// Reads what service/report/pack.cpp wrote: deflated, in byte planes, base64.

async function inflate(chunk) {
  const bytes = Uint8Array.from(atob(chunk), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Takes arrays one after the other from the bytes of a chunk.
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer);
    this.at = 0;
  }

  integers(n) {
    const out = new Int32Array(n);
    const b = this.bytes;
    const p = this.at;
    let value = 0;
    for (let k = 0; k < n; ++k) {
      const step = (b[p + k] << 24) | (b[p + n + k] << 16) | (b[p + 2 * n + k] << 8) | b[p + 3 * n + k];
      value = (value + step) | 0;
      out[k] = value;
    }
    this.at += 4 * n;
    return out;
  }

  // 65535 stands for a number that does not exist.
  quantised(n) {
    const out = new Float32Array(n);
    const low = this.view.getFloat32(this.at, true);
    const high = this.view.getFloat32(this.at + 4, true);
    const p = this.at + 8;
    for (let k = 0; k < n; ++k) {
      const level = (this.bytes[p + k] << 8) | this.bytes[p + n + k];
      out[k] = level === 65535 ? NaN : low + ((high - low) * level) / 65534;
    }
    this.at += 8 + 2 * n;
    return out;
  }

  // Numbers of append_levels(): 255 stands for a number that does not exist.
  levels(n) {
    const out = new Float32Array(n);
    const low = this.view.getFloat32(this.at, true);
    const high = this.view.getFloat32(this.at + 4, true);
    const p = this.at + 8;
    let level = 0;
    for (let k = 0; k < n; ++k) {
      level = (level + this.bytes[p + k]) & 255;
      out[k] = level === 255 ? NaN : low + ((high - low) * level) / 254;
    }
    this.at += 8 + n;
    return out;
  }

  // x, y, z of n points, one point after the other.
  points(n) {
    const axes = [this.quantised(n), this.quantised(n), this.quantised(n)];
    const out = new Float32Array(3 * n);
    for (let k = 0; k < n; ++k) for (let a = 0; a < 3; ++a) out[3 * k + a] = axes[a][k];
    return out;
  }
}

// Shares one promise between all who ask for the same item.
function once(make) {
  const known = new Map();
  return (key) => {
    if (!known.has(key)) known.set(key, make(key));
    return known.get(key);
  };
}

// Fields of substances by name, x fastest.
async function fieldsOf({ n, names }, chunk) {
  const r = new Reader(await inflate(chunk));
  return Object.fromEntries(names.map((name) => [name, r.levels(n[0] * n[1] * n[2])]));
}

// Frames of a run, unpacked when they are first asked for.
export function openFrames(frames) {
  const mesh = once(async (k) => {
    const { nodes, triangles, chunk } = frames.meshes[k];
    const r = new Reader(await inflate(chunk));
    return { nodes, corner: r.integers(3 * triangles), cell: r.integers(nodes), kind: r.integers(nodes) };
  });
  const still = once(async (k) => {
    const { nodes, triangles, chunk } = frames.still[k];
    const r = new Reader(await inflate(chunk));
    return { point: r.points(nodes), corner: r.integers(3 * triangles) };
  });
  const frame = once(async (k) => {
    const f = frames.list[k];
    const [m, s, bytes, fields] = await Promise.all([mesh(f.mesh), still(f.still), inflate(f.chunk), f.fields ? fieldsOf(frames.grid, f.fields) : null]);
    const r = new Reader(bytes);
    const point = r.points(m.nodes);
    const sphere = { center: r.points(f.spheres), radius: r.quantised(f.spheres), id: r.integers(f.spheres) };
    const table = {};
    for (const name of frames.id_columns) table[name] = r.integers(f.cells);
    for (const name of frames.columns) table[name] = r.quantised(f.cells);
    const row = new Map();
    if (table.id) table.id.forEach((id, place) => row.set(id, place));
    return { time: f.time, number: f.number, mesh: m, still: s, point, sphere, table, row, fields };
  });
  return { count: frames.list.length, times: frames.list.map((f) => f.time), frame };
}
