#include "runs/experiments/lesion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acinus::runs {
namespace {

constexpr int kRings = 3;

int n_slices(const LesionFrame& f) {
  return std::max(1, static_cast<int>(std::lround(f.height / (2 * f.cell_radius))));
}

}  // namespace

const std::array<LesionReading, 4>& lesion_readings() {
  static const std::array<LesionReading, 4> readings{
      LesionReading{"slices_centre",
                    "mean over slices of height, by the centre of the nearest cell", false, false},
      LesionReading{"slices_surface",
                    "mean over slices of height, by the surface of the nearest cell", false, true},
      LesionReading{"rings_centre",
                    "mean over the three rings of cells behind the edge, by centres", true, false},
      LesionReading{"rings_surface",
                    "mean over the three rings of cells behind the edge, by surfaces", true, true}};
  return readings;
}

double lesion_radius(std::span<const LesionCell> cells, const LesionFrame& f,
                     const LesionReading& reading) {
  const int n = reading.rings ? kRings : n_slices(f);
  std::vector<double> nearest(n, std::numeric_limits<double>::infinity());
  for (const LesionCell& c : cells) {
    const int layer = reading.rings
                          ? c.layer - 1
                          : std::clamp(static_cast<int>(c.height / f.height * n), 0, n - 1);
    if (layer >= n) continue;
    double& r = nearest[layer];
    r = std::min(r, reading.surface ? c.surface : c.center);
  }
  double sum = 0;
  int counted = 0;
  for (const double r : nearest)
    if (std::isfinite(r)) {
      sum += r;
      ++counted;
    }
  return counted > 0 ? sum / counted : 0;
}

double lesion_floor(const LesionFrame& f, const LesionReading& reading) {
  return f.vein_radius + (reading.surface ? 0 : f.cell_radius) +
         (reading.rings ? 2 * f.cell_radius : 0);
}

double relative_area(double radius, double first, double floor) {
  if (first <= floor) return 0;
  const double open = std::max(radius - floor, 0.0) / (first - floor);
  return open * open;
}

double surface_distance(const contact::SurfaceBody& body, const Vec3& axis_point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : *body.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] > t[(k + 1) % 3]) continue;  // every edge once
      const auto at = [&](int i) -> Eigen::Vector2d {
        return (body.node[i] - axis_point).head<2>();
      };
      const Eigen::Vector2d a = at(t[k]), way = at(t[(k + 1) % 3]) - a;
      const double length2 = way.squaredNorm();
      const double s = length2 > 0 ? std::clamp(-a.dot(way) / length2, 0.0, 1.0) : 0.0;
      least = std::min(least, (a + s * way).norm());
    }
  return least;
}

}  // namespace acinus::runs
