#include "contact/nearest_gap.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "geometry/measures.hpp"

namespace acinus::contact {
namespace {

/// Gap to a static mesh, um, negative where cells may not be; not resolved beyond `enough`.
double gap_to_static_mesh(const StaticMesh& m, const Vec3& x, double enough) {
  const std::vector<Vec3>& node = m.body.node;
  if (!m.inside) {
    Vec3 low = node.front(), high = low;
    for (const Vec3& y : node) low = low.cwiseMin(y), high = high.cwiseMax(y);
    const double away = (x - x.cwiseMax(low).cwiseMin(high)).norm();
    if (away >= enough) return away;
  }
  const double distance = geometry::compute_distance(x, node, *m.triangle);
  // Triangles of a mesh with cells inside face inward: its winding number is -1 inside.
  const bool within = std::abs(geometry::compute_winding_number(x, node, *m.triangle)) > 0.5;
  return within == m.inside ? distance : -distance;
}

}  // namespace

double nearest_gap(const Boundary& boundary, const Vec3& x, std::string* name) {
  double nearest = std::numeric_limits<double>::infinity();
  auto look = [&](double gap, auto label) {
    if (gap >= nearest) return;
    nearest = gap;
    if (name) *name = label();
  };
  for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    look(gap_to_wall(wall, x, 0).gap, [&] { return wall_label(wall); });
  });
  const auto& network = boundary.vessels.network;
  for (int s = 0; s < static_cast<int>(network.segment.size()); ++s)
    look(gap_to_segment(network, s, x).gap, [&] { return fmt::format("vessel segment {}", s); });
  for (const StaticMesh& m : boundary.meshes)
    look(gap_to_static_mesh(m, x, nearest),
         [&] { return fmt::format("static mesh \"{}\"", m.name); });
  return nearest;
}

}  // namespace acinus::contact
