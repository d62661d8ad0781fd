#include "runs/session/make_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "contact/jkr.hpp"
#include "contact/wall_mesh.hpp"
#include "core/error.hpp"
#include "coupling/generate/pipette_surface.hpp"
#include "coupling/generate/vessel_surface.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::runs {
namespace {

using coupling::CellMeasure, coupling::NodeMeasure;

constexpr std::uint8_t kShell = 0, kSphere = 1, kBoundary = 2, kNucleus = 3;

/// Appends one component to a field, in single precision.
void push(io::Field& field, double value) { field.value.push_back(static_cast<float>(value)); }

io::Table cell_table(const std::vector<CellMeasure>& cells) {
  io::Table t;
  io::IdColumn id{"id", {}}, parent{"parent", {}}, kind{"kind", {}}, type{"type", {}},
      leader{"leader", {}}, contacts{"contacts", {}}, phase{"phase", {}};
  io::Column center{"center", "um", 3, {}}, radius{"radius", "um", 1, {}},
      volume{"volume", "um^3", 1, {}}, area{"area", "um^2", 1, {}},
      pressure{"pressure", "kPa", 1, {}}, cytosol{"cytosol_pressure", "kPa", 1, {}},
      stress{"stress", "kPa", 6, {}}, touching{"contact_area", "um^2", 1, {}},
      active{"migration_force", "nN", 1, {}}, pushing{"contact_force", "nN", 1, {}},
      normal{"normal_force", "nN", 1, {}}, progress{"cycle_progress", "1", 1, {}},
      growth{"growth_rate", "um^3/s", 1, {}};
  for (io::IdColumn* c : {&id, &parent, &kind, &type, &leader, &contacts, &phase})
    c->value.reserve(cells.size());
  for (io::Column* c : {&center, &radius, &volume, &area, &pressure, &cytosol, &stress, &touching,
                        &active, &pushing, &normal, &progress, &growth})
    c->value.reserve(cells.size() * static_cast<std::size_t>(c->components));
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
    phase.value.push_back(static_cast<std::int64_t>(c.fate));
    progress.value.push_back(c.progress);
    growth.value.push_back(c.growth_rate);
  }
  for (io::IdColumn* c : {&id, &parent, &kind, &type, &leader, &contacts, &phase})
    t.ids.push_back(std::move(*c));
  for (io::Column* c : {&center, &radius, &volume, &area, &pressure, &cytosol, &stress, &touching,
                        &active, &pushing, &normal, &progress, &growth})
    t.columns.push_back(std::move(*c));
  return t;
}

/// Number of a kind of partner in /contacts: 0 to 2 are those of `kind`.
std::int64_t number_of(contact::Partner partner) {
  switch (partner) {
    case contact::Partner::kSurface:
      return 0;
    case contact::Partner::kSphere:
      return 1;
    case contact::Partner::kVessel:
      return 2;
    case contact::Partner::kPlane:
      return 3;
    case contact::Partner::kCapsule:
      return 4;
    case contact::Partner::kMesh:
      return 5;
    case contact::Partner::kPipette:
      return 6;
    case contact::Partner::kNucleus:
      break;
  }
  throw Error("internal error: a nucleus is no partner of another cell", Exit::kInternal);
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

/// Builder of a frame: appends points, triangles, spheres and their data.
class FrameBuilder {
 public:
  /// @param n_point     nodes of surfaces, and centres of spheres
  /// @param n_triangle  of surfaces
  FrameBuilder(const Snapshot& snapshot, std::size_t n_point, std::size_t n_triangle,
               std::size_t n_sphere)
      : snapshot_(snapshot) {
    frame_.time_s = snapshot.time;
    const std::size_t n_cell = n_triangle + n_sphere;
    frame_.point.reserve(3 * n_point);
    for (io::Field* f : {&force_, &contact_, &tension_})
      f->value.reserve(n_point * static_cast<std::size_t>(f->components));
    frame_.triangle.reserve(n_triangle);
    frame_.cell_id.reserve(n_cell);
    frame_.kind.reserve(n_cell);
    for (io::Field* f : {&type_, &volume_, &pressure_, &cytosol_, &radius_, &leader_, &strength_})
      f->value.reserve(n_cell);
  }

  void add_cell(const contact::SurfaceBody& body, const CellMeasure& cell) {
    const NodeMeasure& nodes = snapshot_.nodes;
    for (const Vec3& x : body.node) {
      push_point(x, nodes.force[node_], nodes.pressure[node_], nodes.tension[node_]);
      ++node_;
    }
    add_triangles(*body.triangle, body.node.size(), &cell, kShell);
  }

  void add_nucleus(const std::vector<Vec3>& node, const std::vector<std::array<int, 3>>& triangle,
                   const CellMeasure& cell) {
    for (const Vec3& x : node) push_point(x, Vec3::Zero(), 0, 0);
    add_triangles(triangle, node.size(), &cell, kNucleus);
  }

  void add_surface(const std::vector<Vec3>& node, const std::vector<std::array<int, 3>>& triangle) {
    for (const Vec3& x : node) push_point(x, Vec3::Zero(), 0, 0);
    add_triangles(triangle, node.size(), nullptr, kBoundary);
  }

  /// Appends a sphere.
  /// @pre all surfaces are appended
  void add_sphere(const CellMeasure& cell) {
    push_point(cell.center, Vec3::Zero(), 0, 0);
    push_cell(&cell, kSphere, cell.radius);
    ++frame_.n_sphere;
  }

  io::Frame finish() {
    frame_.n_mesh_node = base_;
    for (io::Field* f : {&force_, &contact_, &tension_}) frame_.point_data.push_back(std::move(*f));
    for (io::Field* f : {&type_, &volume_, &pressure_, &cytosol_, &radius_, &leader_, &strength_,
                         &phase_, &growth_})
      frame_.cell_data.push_back(std::move(*f));
    frame_.cells = cell_table(snapshot_.cells);
    frame_.interface = interface_table(snapshot_.interface);
    frame_.contacts = contact_table({}, snapshot_.cells);
    return std::move(frame_);
  }

 private:
  void push_point(const Vec3& x, const Vec3& nodal_force, double pressure, double tension) {
    for (int k = 0; k < 3; ++k) frame_.point.push_back(static_cast<float>(x[k]));
    for (int k = 0; k < 3; ++k) push(force_, nodal_force[k]);
    push(contact_, pressure);
    push(tension_, tension);
  }
  void push_cell(const CellMeasure* c, std::uint8_t kind, double sphere_radius) {
    frame_.cell_id.push_back(c ? c->id : -1);
    frame_.kind.push_back(kind);
    push(type_, c ? c->type : -1);
    push(volume_, c ? c->volume : 0);
    push(pressure_, c ? c->pressure : 0);
    push(cytosol_, c ? c->cytosol_pressure : 0);
    push(radius_, sphere_radius);
    push(leader_, c && c->leader ? 1 : 0);
    push(strength_, c ? c->strength : 1);
    push(phase_, c ? static_cast<int>(c->fate) : 0);
    push(growth_, c ? c->growth_rate : 0);
  }
  void add_triangles(const std::vector<std::array<int, 3>>& triangle, std::size_t n_node,
                     const CellMeasure* cell, std::uint8_t kind) {
    for (const auto& t : triangle) {
      frame_.triangle.push_back({base_ + t[0], base_ + t[1], base_ + t[2]});
      push_cell(cell, kind, 0);
    }
    base_ += static_cast<std::int64_t>(n_node);
  }

  const Snapshot& snapshot_;
  io::Frame frame_;
  io::Field force_{"force", "nN", 3, {}}, contact_{"contact_pressure", "kPa", 1, {}},
      tension_{"tension", "nN/um", 1, {}};
  io::Field type_{"cell_type", "1", 1, {}}, volume_{"volume", "um^3", 1, {}},
      pressure_{"pressure", "kPa", 1, {}}, cytosol_{"cytosol_pressure", "kPa", 1, {}},
      radius_{"radius", "um", 1, {}}, leader_{"leader", "1", 1, {}},
      strength_{"strength", "1", 1, {}}, phase_{"phase", "1", 1, {}},
      growth_{"growth_rate", "um^3/s", 1, {}};
  std::int64_t base_ = 0;  ///< number of nodes so far
  std::size_t node_ = 0;   ///< number of cell nodes so far
};

void add_nuclei(const dcm::State& s, const coupling::Workspace& w, const Snapshot& snapshot,
                FrameBuilder& builder) {
  std::vector<Vec3> node;
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b) {
    const std::size_t lane = w.dcm.lane_of_body[b];
    const dcm::NucleusMesh& nucleus = s.group[lane / kLanes].nucleus;
    if (!nucleus.exists()) continue;
    dcm::copy_nucleus(s, lane, node);
    builder.add_nucleus(node, nucleus.topology->triangle, snapshot.cells[b]);
  }
}

}  // namespace

geometry::Surface draw_boundary(const contact::Boundary& boundary) {
  geometry::Surface drawn;
  if (const contact::WallMesh* wall = boundary.vessels.wall.get())
    drawn = {wall->surface.body.node, *wall->surface.triangle};
  else
    drawn = coupling::make_vessel_surface(boundary.vessels.network).surface;
  for (const contact::Pipette& p : boundary.pipettes) coupling::add_pipette_surface(p, drawn);
  return drawn;
}

void add_concentrations(const coupling::World& world, const Snapshot& snapshot, io::Table& cells) {
  const std::vector<std::vector<double>> mean = coupling::cell_concentrations(world);
  if (mean.empty()) return;
  const std::vector<std::vector<double>> rate = coupling::cell_exchange_rates(world);
  const coupling::CellIndex index = coupling::index_cells(world.state);
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::vector<double>& value) {
    io::Column column{name, unit, 1, {}};
    for (const CellMeasure& c : snapshot.cells) column.value.push_back(value[index.at(c.id).index]);
    cells.columns.push_back(std::move(column));
  };
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const auto& [name, unit] = std::tie(world.params.substances.substance[k].name,
                                        world.params.substances.substance[k].unit);
    add("concentration_" + name, unit, mean[k]);
    add("exchange_" + name, (unit == "1" ? "" : unit + " ") + "um^3/s", rate[k]);
  }
}

io::Table contact_table(const std::vector<coupling::CellContact>& contacts,
                        const std::vector<CellMeasure>& cells) {
  io::IdColumn a{"a", {}}, b{"b", {}}, partner{"partner", {}};
  io::Column area_a{"area_a", "um^2", 1, {}}, area_b{"area_b", "um^2", 1, {}},
      force{"force", "nN", 3, {}}, normal{"normal_force", "nN", 1, {}};
  for (const coupling::CellContact& c : contacts) {
    a.value.push_back(cells[c.a].id);
    b.value.push_back(c.b == coupling::kNoCell ? c.index : cells[c.b].id);
    partner.value.push_back(number_of(c.partner));
    area_a.value.push_back(c.area_a);
    area_b.value.push_back(c.area_b);
    for (int k = 0; k < 3; ++k) force.value.push_back(c.force[k]);
    normal.value.push_back(c.normal_force);
  }
  return {{a, b, partner}, {area_a, area_b, force, normal}};
}

io::Frame make_frame(const coupling::World& world, const coupling::Workspace& w,
                     const Snapshot& snapshot, const geometry::Surface& boundary) {
  const std::size_t n_body = w.dcm.body.size(), n_sphere = snapshot.cells.size() - n_body;
  std::size_t n_point = boundary.node.size() + n_sphere, n_triangle = boundary.triangle.size();
  const auto count = [&](std::size_t node, std::size_t triangle) {
    n_point += node;
    n_triangle += triangle;
  };
  for (std::size_t b = 0; b < n_body; ++b) {
    count(w.dcm.body[b].node.size(), w.dcm.body[b].triangle->size());
    const dcm::NucleusMesh& nucleus = world.state.dcm.group[w.dcm.lane_of_body[b] / kLanes].nucleus;
    if (nucleus.exists()) count(nucleus.topology->rest.size(), nucleus.topology->triangle.size());
  }
  for (const contact::StaticMesh& m : world.params.boundary.meshes)
    count(m.body.node.size(), m.triangle->size());
  FrameBuilder builder(snapshot, n_point, n_triangle, n_sphere);
  for (std::size_t b = 0; b < n_body; ++b) builder.add_cell(w.dcm.body[b], snapshot.cells[b]);
  if (dcm::has_nuclei(world.state.dcm)) add_nuclei(world.state.dcm, w, snapshot, builder);
  builder.add_surface(boundary.node, boundary.triangle);
  for (const contact::StaticMesh& m : world.params.boundary.meshes)
    builder.add_surface(m.body.node, *m.triangle);
  for (std::size_t k = n_body; k < snapshot.cells.size(); ++k)
    builder.add_sphere(snapshot.cells[k]);
  return builder.finish();
}

namespace {

/// Indentation of each deformable cell by a sphere that the contact force explains, um: half the
/// JKR overlap of two such spheres under that force, the share of the sphere's own side.
std::vector<coupling::KnownIndentation> explained_indentations(const coupling::World& world,
                                                               const Snapshot& snapshot) {
  const cbm::State& s = world.state.cbm;
  const coupling::CellIndex cells = coupling::index_cells(world.state);
  auto find = [&](std::int64_t id, bool deformable) {
    return std::ranges::find_if(snapshot.cells, [&](const CellMeasure& c) {
      return c.id == id && c.deformable == deformable;
    });
  };
  std::vector<coupling::KnownIndentation> indentations;
  for (const coupling::InterfaceForce& f : snapshot.interface) {
    const auto cell = find(f.dcm_id, true), sphere = find(f.cbm_id, false);
    const std::size_t k = cells.at(f.cbm_id).at;
    const cbm::Params& p = world.params.cbm[s.type[k]];
    const contact::SphereBody body{sphere->radius, s.young[k], p.poisson};
    const double press = f.force.dot((cell->center - sphere->center).normalized());
    indentations.push_back(
        {f.dcm_id, f.cbm_id,
         0.5 * contact::jkr_overlap(contact::reduced_pair(body, body, p.adhesion), press)});
  }
  return indentations;
}

}  // namespace

StaticBodies prepare_static_bodies(const contact::Boundary& boundary) {
  StaticBodies bodies;
  if (const contact::WallMesh* wall = boundary.vessels.wall.get())
    bodies.vessel_surface = coupling::prepare_static_mesh(
        wall->surface.body.node, *wall->surface.triangle, "surface of the vessels");
  for (const contact::StaticMesh& m : boundary.meshes) {
    auto& outward = bodies.outward.emplace_back(*m.triangle);
    if (m.inside)
      for (auto& t : outward) std::swap(t[1], t[2]);
    bodies.mesh.push_back(
        {coupling::prepare_static_mesh(m.body.node, outward,
                                       fmt::format("static mesh {}", bodies.mesh.size())),
         m.inside});
  }
  return bodies;
}

coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& w,
                                  const Snapshot& snapshot, const StaticBodies& bodies) {
  const contact::Boundary& boundary = world.params.boundary;
  const double time = std::max(0.0, snapshot.time);
  std::vector<coupling::AuditMesh> meshes;
  std::vector<coupling::AuditSphere> spheres;
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b)
    meshes.push_back({snapshot.cells[b].id, w.dcm.body[b].node, *w.dcm.body[b].triangle,
                      snapshot.cells[b].newborn});
  for (std::size_t k = w.dcm.body.size(); k < snapshot.cells.size(); ++k)
    spheres.push_back({snapshot.cells[k].id, snapshot.cells[k].center, snapshot.cells[k].radius,
                       snapshot.cells[k].strength, snapshot.cells[k].parent});
  const std::vector<coupling::AuditWall> walls = coupling::make_audit_walls(boundary, time);
  coupling::AuditFrame frame;
  frame.meshes = meshes;
  frame.spheres = spheres;
  const std::vector<coupling::KnownIndentation> indentations =
      explained_indentations(world, snapshot);
  frame.indentations = indentations;
  frame.vessels = &boundary.vessels.network;
  frame.vessel_surface = bodies.vessel_surface ? &*bodies.vessel_surface : nullptr;
  frame.walls = walls;
  frame.static_meshes = bodies.mesh;
  return coupling::audit(frame, world.ranks);
}

}  // namespace acinus::runs
