#include "coupling/take_shapes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/orientation.hpp"
#include "dcm/shape/give_shape.hpp"
#include "dcm/shape/lay_mesh.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

struct Fit {
  std::size_t lane = 0;
  dcm::LaidMesh mesh;
};

}  // namespace

TakenShapes take_shapes(const std::vector<CellSurface>& surfaces, World& world) {
  State& s = world.state;
  std::map<std::int64_t, const geometry::Surface*> surface_of;
  for (const CellSurface& c : surfaces) surface_of[c.lineage] = c.surface;
  std::map<std::int64_t, std::size_t> lane_of;  // ascending by lineage
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t lineage = lineage_of(s, c);
    if (c.deformable && surface_of.contains(lineage)) lane_of[lineage] = c.at;
  });
  const std::vector<std::pair<std::int64_t, std::size_t>> lanes(lane_of.begin(), lane_of.end());
  std::vector<Fit> fits(lanes.size());
  for_each_part(lanes.size(), [&](std::size_t k) {
    const auto& [lineage, lane] = lanes[k];
    fits[k] = {lane, dcm::lay_mesh(*s.dcm.group[lane / kLanes].topology, *surface_of.at(lineage),
                                   random_orientation(world.params.life.seed, lineage))};
  });

  TakenShapes taken;
  const double now = s.clock.time;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const Fit& fit = fits[k];
    if (!fit.mesh.fault.empty()) {
      taken.round.emplace_back(lanes[k].first, fit.mesh.fault);
      continue;
    }
    ++(fit.mesh.inflated ? taken.inflated : taken.laid);
    const dcm::Group& group = s.dcm.group[fit.lane / kLanes];
    const geometry::Surface& surface = *surface_of.at(lanes[k].first);
    const double radius = sphere_radius(geometry::compute_volume(surface.node, surface.triangle));
    dcm::give_shape(world.params.dcm[group.type],
                    {fit.mesh.node, radius, 1, {1, 0, now, now + dcm::kForgetShape}}, fit.lane,
                    s.dcm);
    taken.worst_quality = std::min(
        taken.worst_quality, geometry::compute_quality(fit.mesh.node, group.topology->triangle));
  }
  return taken;
}

}  // namespace acinus::coupling
