// The three.js scene of one run: meshes of deformable cells, spheres, what does not move.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage, HemisphereLight, InstancedBufferAttribute,
  InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, Scene, SphereGeometry, Vector3,
} from "three";
import { colourOf, SELECTED, valueOf } from "./colour.js";
import { makeSection } from "./section.js";
import { FieldSlice } from "./slice.js";
import { FieldSurface } from "./surface.js";
import { disposeOf, drawWalls } from "./walls.js";

const NUCLEUS = 3, OBSTACLE = 2;
const DARK = 0.45; // of the colour of a cell, its nucleus
const LOOSE = 10; // times the width of a dense clump
const MARK = new Color().setRGB(...SELECTED.map((c) => c / 255), "srgb");
export const OBSTACLE_COLOUR = 0xb5645f;
const obstacle = new Color(OBSTACLE_COLOUR);

function material(options) {
  return new MeshLambertMaterial({ side: DoubleSide, ...options });
}

export class Model {
  // walls, grid: of run_part.cpp
  constructor(plane, walls, grid) {
    this.plane = plane;
    this.walls = walls;
    this.drawnWalls = null;
    this.scene = new Scene();
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(0.4, 0.6, 1);
    this.light = key;
    this.scene.add(new HemisphereLight(0xffffff, 0x8a8f98, 1.7), key);
    this.cells = new Mesh(new BufferGeometry(), material({ vertexColors: true, clippingPlanes: [plane] }));
    this.still = new Mesh(new BufferGeometry(), material({ color: OBSTACLE_COLOUR, clippingPlanes: [plane] }));
    this.sphereMaterial = material({ clippingPlanes: [plane] });
    this.spheres = null;
    this.slice = new FieldSlice(grid);
    this.surface = new FieldSurface(plane, grid);
    this.scene.add(this.cells, this.still, ...this.makeSectionParts(), this.slice.mesh, this.surface.group);
    this.marked = null;
    this.showSpheres = true;
    this.isCut = false;
  }

  // Faces lie in one plane. They are drawn in their order without depth, so that the last one is seen, then once more
  // for the depth alone.
  makeSectionParts() {
    const offset = { side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 };
    this.section = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ vertexColors: true, depthWrite: false, ...offset }));
    this.sectionDepth = new Mesh(this.section.geometry, new MeshBasicMaterial({ colorWrite: false, ...offset }));
    this.outlines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: 0x2a2622 }));
    const parts = [this.section, this.sectionDepth, this.outlines];
    parts.forEach((part, k) => { part.renderOrder = k + 1; part.visible = false; });
    return parts;
  }

  // Renews the section faces; call after any change of frame, plane or visibility, and before paint().
  cut(isCut) {
    this.isCut = isCut;
    for (const part of [this.section, this.sectionDepth, this.outlines]) part.visible = isCut;
    if (!isCut) return;
    const { geometry, lines, owner } = makeSection(this.frame, this.plane, { cells: this.cells.visible, spheres: this.showSpheres, still: this.still.visible });
    this.section.geometry.dispose();
    this.outlines.geometry.dispose();
    this.section.geometry = this.sectionDepth.geometry = geometry;
    this.outlines.geometry = lines;
    this.owner = owner;
  }

  // Shows a slice of a field in the plane of the cut, over the faces of cells, so that their outlines are left; of cells
  // that the substance avoids under the faces. Its order places it: it leaves no depth.
  showSlice(field, axis, at, range, avoidsCells) {
    this.slice.show(this.frame, field, axis, at, range);
    this.slice.mesh.renderOrder = avoidsCells ? 0.5 : 2.5;
  }

  // visit(x, y, z) for the corners of the boxes of the slice and of the surface that are shown
  forEachFieldCorner(visit) {
    this.slice.forEachCorner(visit);
    this.surface.forEachCorner(visit);
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
    this.renewWalls();
  }

  renewWalls() {
    if (this.walls.length === 0) return;
    const visible = this.drawnWalls?.visible ?? true;
    if (this.drawnWalls) {
      this.scene.remove(this.drawnWalls);
      disposeOf(this.drawnWalls);
    }
    this.drawnWalls = drawWalls(this.walls, this.frame.time, this.box());
    this.drawnWalls.visible = visible;
    this.scene.add(this.drawnWalls);
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
      const [wide, high] = n > 100000 ? [6, 4] : n > 2000 ? [9, 6] : [24, 16];
      this.spheres = new InstancedMesh(new SphereGeometry(1, wide, high), this.sphereMaterial, n);
      this.spheres.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * n), 3);
      this.spheres.visible = this.showSpheres;
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
      const dark = mesh.kind[k] === NUCLEUS ? DARK : 1;
      into.setXYZ(k, dark * c.r, dark * c.g, dark * c.b);
    }
    into.needsUpdate = true;
    for (let k = 0; k < sphere.id.length; ++k) this.spheres.setColorAt(k, colour(sphere.id[k]));
    if (this.spheres.instanceColor) this.spheres.instanceColor.needsUpdate = true;
    if (this.isCut) this.paintSection(colour);
  }

  paintSection(colour) {
    const into = this.section.geometry.getAttribute("color");
    this.owner.forEach(({ id, kind }, face) => {
      const c = kind === OBSTACLE ? obstacle : colour(id);
      const dark = kind === NUCLEUS ? DARK : 1;
      for (let k = 3 * face; k < 3 * face + 3; ++k) into.setXYZ(k, dark * c.r, dark * c.g, dark * c.b);
    });
    into.needsUpdate = true;
  }

  // The cell hit first by a ray, of what is not cut away.
  pick(ray) {
    const hits = ray.intersectObjects([this.cells, this.spheres, this.section].filter((o) => o?.visible));
    const first = hits.find((h) => h.object === this.section || this.plane.distanceToPoint(h.point) >= 0);
    if (!first) return null;
    // The last of the section faces at this point is the one seen.
    const hit = first.object !== this.section ? first : hits.filter((h) => h.object === this.section).reduce((a, b) => (b.faceIndex > a.faceIndex ? b : a));
    if (hit.object === this.section) return this.owner[hit.faceIndex].id < 0 ? null : this.owner[hit.faceIndex].id;
    return hit.object === this.spheres ? this.frame.sphere.id[hit.instanceId] : this.frame.mesh.cell[hit.face.a];
  }

  // Box around cells and obstacles that are meshes: [low, high].
  box() {
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = low.clone().negate();
    const p = new Vector3();
    this.forEachPoint((x, y, z, r) => {
      low.min(p.set(x - r, y - r, z - r));
      high.max(p.set(x + r, y + r, z + r));
    });
    return low.x > high.x ? [new Vector3(-1, -1, -1), new Vector3(1, 1, 1)] : [low, high];
  }

  // True unless the cells are far apart for their number and size.
  isCompact() {
    const { table, still } = this.frame;
    const n = this.frame.row.size;
    if (n === 0 || !table.radius || still.corner.length > 0) return true;
    const [low, high] = this.box();
    return low.distanceTo(high) <= LOOSE * Math.cbrt(n) * 2 * table.radius.reduce((a, r) => Math.max(a, r), 0);
  }

  // visit(x, y, z, radius) for every node and sphere
  forEachPoint(visit) {
    const each = (points, radius) => {
      for (let k = 0; k < points.length / 3; ++k) visit(points[3 * k], points[3 * k + 1], points[3 * k + 2], radius ? radius[k] : 0);
    };
    each(this.frame.point);
    each(this.frame.still.point);
    each(this.frame.sphere.center, this.frame.sphere.radius);
  }

  // The same with what is shown of the fields.
  fullBox() {
    const [low, high] = this.box();
    const p = new Vector3();
    this.forEachFieldCorner((x, y, z) => { low.min(p.set(x, y, z)); high.max(p); });
    return [low, high];
  }

  // Points that a picture of everything has to hold, walls included: visit(x, y, z, radius).
  forEachDrawn(visit) {
    this.forEachPoint(visit);
    this.forEachFieldCorner((x, y, z) => visit(x, y, z, 0));
    this.drawnWalls?.traverse((o) => {
      const position = o.geometry?.getAttribute("position");
      for (let k = 0; k < (position?.count ?? 0); ++k) visit(position.getX(k) + o.position.x, position.getY(k) + o.position.y, position.getZ(k) + o.position.z, 0);
    });
  }
}
