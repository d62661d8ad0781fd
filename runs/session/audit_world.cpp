#include "runs/session/audit_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "contact/jkr.hpp"
#include "contact/wall_mesh.hpp"
#include "coupling/measure/cell_numbers.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::runs {
namespace {

/// Indentation of each own deformable cell by a sphere that the contact force explains, um: half
/// the JKR overlap of two such spheres under that force, the share of the sphere's own side.
std::vector<coupling::KnownIndentation> explained_indentations(const coupling::World& world,
                                                               const coupling::Workspace& w,
                                                               const Snapshot& snapshot) {
  const cbm::State& s = world.state.cbm;
  const coupling::CellIndex cells = coupling::index_cells(world.state);
  auto find = [&](std::int64_t id, bool deformable) {
    return std::ranges::find_if(snapshot.cells, [&](const coupling::CellMeasure& c) {
      return c.id == id && c.deformable == deformable;
    });
  };
  std::vector<coupling::KnownIndentation> indentations;
  for (const coupling::InterfaceForce& f : snapshot.interface) {
    if (w.dcm.is_ghost(cells.at(f.dcm_id).at)) continue;  // its owner audits it
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
  const coupling::CellNumbers numbers = coupling::number_cells(world.state, w);
  std::vector<coupling::AuditMesh> meshes;
  std::vector<coupling::AuditSphere> spheres;
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b) {
    const std::size_t k = numbers.of_body[b];
    const coupling::CellMeasure& cell = snapshot.cells[k];
    meshes.push_back({cell.id, w.dcm.body[b].node, *w.dcm.body[b].triangle, cell.newborn,
                      !w.dcm.is_ghost_body(b), k});
  }
  for (std::size_t c = 0; c < world.state.cbm.n_cell(); ++c) {
    if (w.cbm.is_absent(c)) continue;
    const std::size_t k = numbers.of_sphere(c);
    const coupling::CellMeasure& cell = snapshot.cells[k];
    spheres.push_back(
        {cell.id, cell.center, cell.radius, cell.strength, cell.parent, !w.cbm.is_ghost(c), k});
  }
  const std::vector<coupling::AuditWall> walls = coupling::make_audit_walls(boundary, time);
  coupling::AuditFrame frame;
  frame.meshes = meshes;
  frame.spheres = spheres;
  const std::vector<coupling::KnownIndentation> indentations =
      explained_indentations(world, w, snapshot);
  frame.indentations = indentations;
  frame.vessels = &boundary.vessels.network;
  frame.vessel_surface = bodies.vessel_surface ? &*bodies.vessel_surface : nullptr;
  frame.walls = walls;
  frame.static_meshes = bodies.mesh;
  return coupling::audit(frame, w.system.ownership.is_whole() ? Ranks::serial() : world.ranks);
}

}  // namespace acinus::runs
