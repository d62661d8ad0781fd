// The three.js scene of one run: meshes of deformable cells, spheres, what does not move.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage, HemisphereLight, InstancedBufferAttribute,
  InstancedMesh, Matrix4, Mesh, MeshLambertMaterial, Scene, SphereGeometry, Vector3,
} from "three";
import { colourOf, valueOf } from "./colour.js";

const NUCLEUS = 3;
const MARK = new Color(1, 0.35, 0.1);

function material(options) {
  return new MeshLambertMaterial({ side: DoubleSide, ...options });
}

export class Model {
  constructor(plane) {
    this.scene = new Scene();
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(0.4, 0.6, 1);
    this.light = key;
    this.scene.add(new HemisphereLight(0xffffff, 0x8a8f98, 1.7), key);
    this.cells = new Mesh(new BufferGeometry(), material({ vertexColors: true, clippingPlanes: [plane] }));
    this.still = new Mesh(new BufferGeometry(), material({ color: 0xb5645f, clippingPlanes: [plane] }));
    this.sphereMaterial = material({ clippingPlanes: [plane] });
    this.spheres = null;
    this.scene.add(this.cells, this.still);
    this.marked = null;
  }

  show(frame) {
    this.frame = frame;
    const g = new BufferGeometry();
    g.setAttribute("position", new BufferAttribute(frame.point, 3));
    g.setAttribute("color", new BufferAttribute(new Float32Array(frame.point.length), 3).setUsage(DynamicDrawUsage));
    g.setIndex(new BufferAttribute(new Uint32Array(frame.mesh.corner), 1));
    g.computeVertexNormals();
    this.cells.geometry.dispose();
    this.cells.geometry = g;
    if (this.shownStill !== frame.still) {
      const s = new BufferGeometry();
      s.setAttribute("position", new BufferAttribute(frame.still.point, 3));
      s.setIndex(new BufferAttribute(new Uint32Array(frame.still.corner), 1));
      s.computeVertexNormals();
      this.still.geometry.dispose();
      this.still.geometry = s;
      this.shownStill = frame.still;
    }
    this.placeSpheres(frame.sphere);
  }

  placeSpheres({ center, radius, id }) {
    const n = id.length;
    if (!this.spheres || this.spheres.count !== n) {
      if (this.spheres) {
        this.scene.remove(this.spheres);
        this.spheres.geometry.dispose();
        this.spheres.dispose();
      }
      // Coarser where there are many: they are small on the screen then.
      const [wide, high] = n > 2000 ? [9, 6] : [24, 16];
      this.spheres = new InstancedMesh(new SphereGeometry(1, wide, high), this.sphereMaterial, n);
      this.spheres.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * n), 3);
      this.spheres.visible = this.showSpheres !== false;
      this.scene.add(this.spheres);
    }
    const m = new Matrix4();
    for (let k = 0; k < n; ++k) {
      const r = radius[k];
      m.set(r, 0, 0, center[3 * k], 0, r, 0, center[3 * k + 1], 0, 0, r, center[3 * k + 2], 0, 0, 0, 1);
      this.spheres.setMatrixAt(k, m);
    }
    this.spheres.instanceMatrix.needsUpdate = true;
    this.spheres.computeBoundingSphere();
  }

  paint(field, range) {
    const { mesh, sphere, table, row } = this.frame;
    const known = new Map();
    const colour = (id) => {
      if (!known.has(id)) {
        const at = row.get(id);
        const c = at == null ? [0.6, 0.6, 0.6] : colourOf(field, valueOf(field, table, at), range);
        known.set(id, id === this.marked ? MARK : new Color().setRGB(...c, "srgb"));
      }
      return known.get(id);
    };
    const into = this.cells.geometry.getAttribute("color");
    for (let k = 0; k < mesh.cell.length; ++k) {
      const c = colour(mesh.cell[k]);
      const dark = mesh.kind[k] === NUCLEUS ? 0.45 : 1;
      into.setXYZ(k, dark * c.r, dark * c.g, dark * c.b);
    }
    into.needsUpdate = true;
    for (let k = 0; k < sphere.id.length; ++k) this.spheres.setColorAt(k, colour(sphere.id[k]));
    if (this.spheres.instanceColor) this.spheres.instanceColor.needsUpdate = true;
  }

  // The cell hit first by a ray, of what is not cut away.
  pick(ray, plane) {
    const hits = ray.intersectObjects([this.cells, this.spheres].filter((o) => o?.visible));
    const hit = hits.find((h) => plane.distanceToPoint(h.point) >= 0);
    if (!hit) return null;
    return hit.object === this.spheres ? this.frame.sphere.id[hit.instanceId] : this.frame.mesh.cell[hit.face.a];
  }

  // Box around all cells: [low, high].
  box() {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = low.clone().negate();
    const take = (points, radius) => {
      for (let k = 0; k < points.length / 3; ++k) {
        const p = new Vector3(points[3 * k], points[3 * k + 1], points[3 * k + 2]);
        const r = radius ? radius[k] : 0;
        low.min(p.clone().subScalar(r));
        high.max(p.addScalar(r));
      }
    };
    take(this.frame.point);
    take(this.frame.sphere.center, this.frame.sphere.radius);
    return [low, high];
  }
}
