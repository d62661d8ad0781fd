#include "calibration/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/curve.hpp"

namespace acinus::calibration {
double capsule_excess(const Compression& cells, const std::vector<ClumpSnapshot>& spheres,
                      double highest) {
  std::vector<double> force;
  for (const Bulk& b : measure_bulks(spheres, cells.inner)) force.push_back(b.force);
  const std::vector<Bulk> bulks = measure_bulks(cells.snapshots, cells.inner);
  double sum = 0;
  int n = 0;
  for (const std::size_t k : find_pressing(bulks, highest)) {
    const double at = find_last_rise(force, bulks[k].force);
    if (!std::isfinite(at)) continue;
    const auto before = std::min(static_cast<std::size_t>(at), spheres.size() - 2);
    const double excess = std::lerp(spheres[before].capsule, spheres[before + 1].capsule,
                                    at - static_cast<double>(before)) -
                          cells.snapshots[k].capsule;
    if (!std::isfinite(excess)) continue;  // a capsule that has opened
    sum += excess;
    ++n;
  }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace acinus::calibration
