#include "runs/session/frame.hpp"

#include <algorithm>
#include <utility>

#include "core/contact/jkr.hpp"
#include "coupling/step/stages.hpp"

namespace acinus::runs {
namespace {

using coupling::CellMeasure;

constexpr std::uint8_t kShell = 0, kSphere = 1, kSurroundings = 2;

/// Appends one number per component.
void push(io::Field& field, double value) { field.value.push_back(static_cast<float>(value)); }

io::Table cell_table(const std::vector<CellMeasure>& cells) {
  io::Table t;
  io::IdColumn id{"id", {}}, parent{"parent", {}}, kind{"kind", {}}, type{"type", {}},
      leader{"leader", {}}, contacts{"contacts", {}};
  io::Column center{"center", "um", 3, {}}, radius{"radius", "um", 1, {}},
      volume{"volume", "um^3", 1, {}}, area{"area", "um^2", 1, {}},
      pressure{"pressure", "kPa", 1, {}}, cytosol{"cytosol_pressure", "kPa", 1, {}},
      stress{"stress", "kPa", 6, {}}, touching{"contact_area", "um^2", 1, {}},
      active{"migration_force", "nN", 1, {}}, pushing{"contact_force", "nN", 1, {}},
      normal{"normal_force", "nN", 1, {}};
  for (const CellMeasure& c : cells) {
    id.value.push_back(c.id);
    parent.value.push_back(c.parent);
    kind.value.push_back(c.deformable ? kShell : kSphere);
    type.value.push_back(c.type);
    leader.value.push_back(c.leader ? 1 : 0);
    contacts.value.push_back(c.contacts);
    for (int k = 0; k < 3; ++k) center.value.push_back(c.center[k]);
    radius.value.push_back(c.radius);
    volume.value.push_back(c.volume);
    area.value.push_back(c.area);
    pressure.value.push_back(c.pressure);
    cytosol.value.push_back(c.cytosol_pressure);
    stress.value.insert(stress.value.end(), c.stress.begin(), c.stress.end());
    touching.value.push_back(c.contact_area);
    active.value.push_back(c.migration_force);
    pushing.value.push_back(c.contact_force);
    normal.value.push_back(c.normal_force);
  }
  t.ids = {id, parent, kind, type, leader, contacts};
  t.columns = {center, radius,   volume, area,    pressure, cytosol,
               stress, touching, active, pushing, normal};
  return t;
}

io::Table interface_table(const std::vector<coupling::InterfaceForce>& forces) {
  io::IdColumn dcm{"dcm_id", {}}, cbm{"cbm_id", {}};
  io::Column force{"force", "nN", 3, {}}, area{"area", "um^2", 1, {}}, gap{"gap", "um", 1, {}};
  for (const coupling::InterfaceForce& f : forces) {
    dcm.value.push_back(f.dcm_id);
    cbm.value.push_back(f.cbm_id);
    for (int k = 0; k < 3; ++k) force.value.push_back(f.force[k]);
    area.value.push_back(f.area);
    gap.value.push_back(f.gap);
  }
  return {{dcm, cbm}, {force, area, gap}};
}

}  // namespace

Snapshot take_snapshot(const coupling::World& world, coupling::Workspace& work) {
  coupling::observe(world, work);
  return {coupling::time_since_start(world), coupling::measure_cells(world, work),
          coupling::measure_nodes(world, work), coupling::interface_forces(world, work)};
}

io::Frame make_frame(const coupling::World& world, const coupling::Workspace& w,
                     const Snapshot& snapshot, const coupling::VesselSurface& vessels) {
  io::Frame f;
  f.time_s = snapshot.time;
  io::Field force{"force", "nN", 3, {}}, contact{"contact_pressure", "kPa", 1, {}},
      tension{"tension", "nN/um", 1, {}};
  io::Field type{"cell_type", "1", 1, {}}, volume{"volume", "um^3", 1, {}},
      pressure{"pressure", "kPa", 1, {}}, cytosol{"cytosol_pressure", "kPa", 1, {}},
      radius{"radius", "um", 1, {}}, leader{"leader", "1", 1, {}}, strength{"strength", "1", 1, {}};
  auto push_point = [&](const Vec3& x) {
    for (int k = 0; k < 3; ++k) f.point.push_back(static_cast<float>(x[k]));
  };
  auto push_node = [&](const Vec3& nodal_force, double p, double t) {
    for (int k = 0; k < 3; ++k) push(force, nodal_force[k]);
    push(contact, p);
    push(tension, t);
  };
  auto push_cell = [&](const CellMeasure* c, std::uint8_t kind, double sphere_radius) {
    f.cell_id.push_back(c ? c->id : -1);
    f.kind.push_back(kind);
    push(type, c ? c->type : -1);
    push(volume, c ? c->volume : 0);
    push(pressure, c ? c->pressure : 0);
    push(cytosol, c ? c->cytosol_pressure : 0);
    push(radius, sphere_radius);
    push(leader, c && c->leader ? 1 : 0);
    push(strength, c ? c->strength : 1);
  };

  std::int64_t base = 0;
  std::size_t node = 0;
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b) {
    for (const Vec3& x : w.dcm.body[b].node) {
      push_point(x);
      push_node(snapshot.nodes.force[node], snapshot.nodes.pressure[node],
                snapshot.nodes.tension[node]);
      ++node;
    }
    for (const auto& t : *w.dcm.body[b].triangle) {
      f.triangle.push_back({base + t[0], base + t[1], base + t[2]});
      push_cell(&snapshot.cells[b], kShell, 0);
    }
    base += static_cast<std::int64_t>(w.dcm.body[b].node.size());
  }
  auto push_surface = [&](const std::vector<Vec3>& nodes,
                          const std::vector<std::array<int, 3>>& triangles) {
    for (const Vec3& x : nodes) {
      push_point(x);
      push_node(Vec3::Zero(), 0, 0);
    }
    for (const auto& t : triangles) {
      f.triangle.push_back({base + t[0], base + t[1], base + t[2]});
      push_cell(nullptr, kSurroundings, 0);
    }
    base += static_cast<std::int64_t>(nodes.size());
  };
  push_surface(vessels.surface.node, vessels.surface.triangle);
  for (const contact::StaticMesh& m : world.params.around.meshes)
    push_surface(m.body.node, m.triangle);
  f.n_mesh_node = base;
  for (std::size_t k = w.dcm.body.size(); k < snapshot.cells.size(); ++k) {
    push_point(snapshot.cells[k].center);
    push_node(Vec3::Zero(), 0, 0);
    push_cell(&snapshot.cells[k], kSphere, snapshot.cells[k].radius);
    ++f.n_sphere;
  }
  f.point_data = {std::move(force), std::move(contact), std::move(tension)};
  f.cell_data = {std::move(type),   std::move(volume), std::move(pressure), std::move(cytosol),
                 std::move(radius), std::move(leader), std::move(strength)};
  f.cells = cell_table(snapshot.cells);
  f.interface = interface_table(snapshot.interface);
  return f;
}

namespace {

/// Half the JKR overlap of two such spheres under the pair's force: how far the sphere's own side
/// yields.
std::vector<coupling::AuditDent> explained_dents(const coupling::World& world,
                                                 const Snapshot& snapshot) {
  const cbm::State& s = world.state.cbm;
  auto find = [&](std::int64_t id, bool deformable) {
    return std::ranges::find_if(snapshot.cells, [&](const CellMeasure& c) {
      return c.id == id && c.deformable == deformable;
    });
  };
  std::vector<coupling::AuditDent> dents;
  for (const coupling::InterfaceForce& f : snapshot.interface) {
    const auto cell = find(f.dcm_id, true), sphere = find(f.cbm_id, false);
    const auto k =
        static_cast<std::size_t>(std::ranges::find(s.lineage, f.cbm_id) - s.lineage.begin());
    const cbm::Params& p = world.params.cbm[static_cast<std::size_t>(s.type[k])];
    const contact::SphereBody body{sphere->radius, s.young[k], p.poisson};
    const double press = f.force.dot((cell->center - sphere->center).normalized());
    dents.push_back(
        {f.dcm_id, f.cbm_id,
         0.5 * contact::jkr_overlap(contact::reduced_pair(body, body, p.adhesion), press)});
  }
  return dents;
}

}  // namespace

coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& w,
                                  const Snapshot& snapshot) {
  const contact::Surroundings& around = world.params.around;
  const double time = std::max(0.0, snapshot.time);
  std::vector<coupling::AuditMesh> meshes;
  std::vector<coupling::AuditSphere> spheres;
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b)
    meshes.push_back({snapshot.cells[b].id, w.dcm.body[b].node, *w.dcm.body[b].triangle,
                      snapshot.cells[b].newborn});
  for (std::size_t k = w.dcm.body.size(); k < snapshot.cells.size(); ++k)
    spheres.push_back({snapshot.cells[k].id, snapshot.cells[k].center, snapshot.cells[k].radius,
                       snapshot.cells[k].strength, snapshot.cells[k].parent});
  std::vector<coupling::AuditPlane> planes;
  for (const contact::Plane& p : around.planes) planes.push_back({p.point_at(time), p.normal});
  std::vector<coupling::AuditCapsule> capsules;
  for (const contact::Capsule& c : around.capsules)
    capsules.push_back({c.center, c.radius_at(time)});
  std::vector<std::vector<std::array<int, 3>>> outward;
  std::vector<coupling::AuditStatic> statics;
  outward.reserve(around.meshes.size());
  for (const contact::StaticMesh& m : around.meshes) {
    outward.push_back(m.triangle);
    if (m.inside)
      for (auto& t : outward.back()) std::swap(t[1], t[2]);
    statics.push_back({m.body.node, outward.back(), m.inside});
  }
  coupling::AuditFrame frame;
  frame.meshes = meshes;
  frame.spheres = spheres;
  const std::vector<coupling::AuditDent> dents = explained_dents(world, snapshot);
  frame.dents = dents;
  frame.vessels = &around.vessels.network;
  frame.planes = planes;
  frame.capsules = capsules;
  frame.statics = statics;
  return coupling::audit(frame);
}

}  // namespace acinus::runs
