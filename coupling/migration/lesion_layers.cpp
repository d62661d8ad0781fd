#include "coupling/migration/lesion_layers.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::coupling {

namespace {

/// Cell in cylindrical coordinates around the axis.
struct AroundAxis {
  double distance, angle, height;
};
AroundAxis around_axis(const LayerCell& cell, const Vec3& axis_point) {
  const Vec3 d = cell.center - axis_point;
  return {std::hypot(d.x(), d.y()), std::atan2(d.y(), d.x()), d.z()};
}

/// True if a cell stands before another of this diameter.
bool is_before(const AroundAxis& c, const AroundAxis& own, double diameter) {
  if (c.distance >= own.distance || std::abs(c.height - own.height) >= diameter) return false;
  const double turn = std::remainder(c.angle - own.angle, 2 * kPi);
  return std::abs(turn) * own.distance < diameter;
}

int layer_at(double behind, double radius) {
  return 1 + static_cast<int>(std::lround(behind / (2 * radius)));
}

}  // namespace

double distance_to_edge(const LayerCell& cell, std::span<const LayerCell> cells,
                        const Vec3& axis_point) {
  const AroundAxis own = around_axis(cell, axis_point);
  double edge = own.distance;
  for (const LayerCell& c : cells) {
    const AroundAxis at = around_axis(c, axis_point);
    if (at.distance < edge && is_before(at, own, 2 * cell.radius)) edge = at.distance;
  }
  return own.distance - edge;
}

int local_layer_of(const LayerCell& cell, std::span<const LayerCell> cells,
                   const Vec3& axis_point) {
  return layer_at(distance_to_edge(cell, cells, axis_point), cell.radius);
}

std::vector<int> compute_layers(std::span<const LayerCell> cells, const Vec3& axis_point) {
  std::vector<AroundAxis> place, outward;
  for (const LayerCell& c : cells) place.push_back(around_axis(c, axis_point));
  outward = place;
  std::ranges::sort(outward, {}, &AroundAxis::distance);
  std::vector<int> layer;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    // The first one before it is the edge.
    const auto edge = std::ranges::find_if(outward, [&](const AroundAxis& c) {
      return c.distance >= place[k].distance || is_before(c, place[k], 2 * cells[k].radius);
    });
    layer.push_back(
        layer_at(place[k].distance - std::min(edge->distance, place[k].distance), cells[k].radius));
  }
  return layer;
}

}  // namespace acinus::coupling
