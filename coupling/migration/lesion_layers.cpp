#include "coupling/migration/lesion_layers.hpp"

#include <cmath>

namespace acinus::coupling {

double distance_to_edge(const LayerCell& cell, std::span<const LayerCell> cells,
                        const Vec3& axis_point) {
  const Vec3 own = cell.center - axis_point;
  const double distance = std::hypot(own.x(), own.y()), diameter = 2 * cell.radius;
  const double angle = std::atan2(own.y(), own.x());
  double edge = distance;
  for (const LayerCell& c : cells) {
    const Vec3 d = c.center - axis_point;
    const double r = std::hypot(d.x(), d.y());
    if (r >= edge || std::abs(d.z() - own.z()) >= diameter) continue;
    const double turn = std::remainder(std::atan2(d.y(), d.x()) - angle, 2 * kPi);
    if (std::abs(turn) * distance < diameter) edge = r;
  }
  return distance - edge;
}

int local_layer_of(const LayerCell& cell, std::span<const LayerCell> cells,
                   const Vec3& axis_point) {
  return 1 + static_cast<int>(
                 std::lround(distance_to_edge(cell, cells, axis_point) / (2 * cell.radius)));
}

std::vector<int> compute_layers(std::span<const LayerCell> cells, const Vec3& axis_point) {
  std::vector<int> layer;
  for (const LayerCell& c : cells) layer.push_back(local_layer_of(c, cells, axis_point));
  return layer;
}

}  // namespace acinus::coupling
