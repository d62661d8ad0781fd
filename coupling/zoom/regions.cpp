#include "coupling/zoom/regions.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel/threads.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::coupling {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Number of cells from which threads pay.
constexpr std::size_t kMany = 200;

/// Centres of the cells followed by a region.
std::vector<Vec3> list_followed(const Region& r, std::span<const ZoomCell> cells) {
  std::vector<Vec3> followed;
  if (r.kind != RegionKind::kCells) return followed;
  const auto is_meant = [&](std::int64_t lineage) {
    return std::ranges::find(r.cells, lineage) != r.cells.end();
  };
  for (const ZoomCell& c : cells)
    if (is_meant(c.lineage) || (r.offspring && c.founder >= 0 && is_meant(c.founder)))
      followed.push_back(c.center);
  return followed;
}

double nearest_of(const std::vector<Vec3>& places, const Vec3& x) {
  double nearest = kFar;
  for (const Vec3& y : places) nearest = std::min(nearest, (x - y).norm());
  return nearest;
}

}  // namespace

bool zoom_needs_pressure(const ZoomParams& zoom) {
  return std::ranges::any_of(zoom.region,
                             [](const Region& r) { return r.kind == RegionKind::kPressure; });
}

std::vector<double> distances_from_zoom(const ZoomParams& zoom, const geometry::Network& vessels,
                                        std::span<const ZoomCell> cells) {
  std::vector<LayerCell> layer_cells(cells.begin(), cells.end());
  std::vector<double> nearest(cells.size(), kFar);
  for (const Region& r : zoom.region) {
    const std::vector<Vec3> followed = list_followed(r, cells);
    const auto distance_of = [&](const ZoomCell& c) {
      switch (r.kind) {
        case RegionKind::kFront:
          return distance_to_edge(c, layer_cells, zoom.axis_point) - r.max_distance;
        case RegionKind::kCells:
          return nearest_of(followed, c.center) - r.max_distance;
        case RegionKind::kVessel:
          return geometry::nearest_segment(vessels, c.center).gap - r.max_distance;
        case RegionKind::kPressure:
          return c.pressure >= r.above ? 0 : c.pressure > r.below ? 0.5 * zoom.margin : kFar;
        default:
          return distance_outside(r, zoom.axis_point, c.center);
      }
    };
    for_each_index(cells.size(), cells.size() > kMany, [&](std::size_t k) {
      nearest[k] = std::min(nearest[k], distance_of(cells[k]));
    });
  }
  return nearest;
}

}  // namespace acinus::coupling
