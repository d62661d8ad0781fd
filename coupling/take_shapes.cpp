#include "coupling/take_shapes.hpp"

#include <algorithm>
#include <map>

#include "core/mesh/measures.hpp"
#include "core/sphere.hpp"
#include "core/threads.hpp"
#include "coupling/life/fill.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/orientation.hpp"
#include "dcm/give_shape.hpp"
#include "dcm/lay_mesh.hpp"
#include "dcm/split.hpp"

namespace acinus::coupling {
namespace {

struct Fit {
  std::size_t lane = 0;
  std::vector<Vec3> node;
  bool filled = false;
  std::string cause;  ///< empty: it fits
};

Fit fit_mesh(const World& world, std::size_t lane, const mesh::Surface& surface) {
  const dcm::State& s = world.state.dcm;
  const dcm::Group& group = s.group[lane / kLanes];
  const mesh::Topology& topology = *group.topology;
  Fit fit;
  fit.lane = lane;
  const Mat3 rotation = random_orientation(world.params.life.seed, s.lineage[lane]);
  if (auto node = dcm::lay_mesh(topology, surface, rotation)) {
    fit.cause = find_mesh_fault(topology, *node);
    fit.node = std::move(*node);
    if (fit.cause.empty()) return fit;
  }
  Filling filling = fill_from_inside(world, group.type, topology, surface);
  fit.filled = true;
  fit.cause = filling.cause;
  if (!filling.ok) return fit;
  const std::vector<double> weight(filling.node.size(), 1);
  const double volume = mesh::compute_volume(surface.node, surface.triangle);
  if (!dcm::match_volume(topology, volume, weight, filling.node))
    fit.cause = "the mesh does not fill it";
  else
    fit.cause = find_mesh_fault(topology, filling.node);
  fit.node = std::move(filling.node);
  return fit;
}

}  // namespace

TakenShapes take_shapes(const std::vector<CellSurface>& surfaces, World& world) {
  State& s = world.state;
  std::map<std::int64_t, const mesh::Surface*> surface_of;
  for (const CellSurface& c : surfaces) surface_of[c.lineage] = c.surface;
  std::map<std::int64_t, std::size_t> lane_of;  // ascending by lineage
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t lineage = lineage_of(s, c);
    if (c.deformable && surface_of.contains(lineage)) lane_of[lineage] = c.at;
  });
  const std::vector<std::pair<std::int64_t, std::size_t>> lanes(lane_of.begin(), lane_of.end());
  std::vector<Fit> fits(lanes.size());
  for_each_part(lanes.size(), [&](std::size_t k) {
    fits[k] = fit_mesh(world, lanes[k].second, *surface_of.at(lanes[k].first));
  });

  TakenShapes taken;
  const double now = s.clock.time;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const Fit& fit = fits[k];
    if (!fit.cause.empty()) {
      taken.round.emplace_back(lanes[k].first, fit.cause);
      continue;
    }
    fit.filled ? ++taken.filled : ++taken.laid;
    const dcm::Group& group = s.dcm.group[fit.lane / kLanes];
    const mesh::Surface& surface = *surface_of.at(lanes[k].first);
    const double radius = sphere_radius(mesh::compute_volume(surface.node, surface.triangle));
    dcm::give_shape(world.params.dcm[group.type],
                    {fit.node, radius, 1, {1, 0, now, now + dcm::kForgetShape}}, fit.lane, s.dcm);
    taken.worst_quality =
        std::min(taken.worst_quality, mesh::compute_quality(fit.node, group.topology->triangle));
  }
  return taken;
}

}  // namespace acinus::coupling
