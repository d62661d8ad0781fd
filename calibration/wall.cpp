#include "calibration/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acinus::calibration {
namespace {

/// Radius of the capsule when the inner cells first bear a force for good. NaN: never.
double capsule_at(const std::vector<Moment>& history, const std::vector<double>& force,
                  double wanted) {
  for (std::size_t k = force.size(); k-- > 1;) {
    if (force[k - 1] > wanted || force[k] <= wanted) continue;
    const double share = (wanted - force[k - 1]) / (force[k] - force[k - 1]);
    return history[k - 1].capsule + share * (history[k].capsule - history[k - 1].capsule);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double capsule_excess(const Squeeze& cells, const std::vector<Moment>& spheres, double highest) {
  std::vector<double> force;
  for (const Moment& m : spheres) force.push_back(measure_bulk(m, cells.inner).force);
  std::vector<Bulk> bulk;
  double largest = 0;
  for (const Moment& m : cells.moment) {
    bulk.push_back(measure_bulk(m, cells.inner));
    largest = std::max(largest, bulk.back().force);
  }
  double sum = 0;
  int n = 0;
  for (std::size_t k = 0; k < bulk.size(); ++k) {
    if (bulk[k].force < kPresses * largest || bulk[k].overlap > highest) continue;
    const double radius = capsule_at(spheres, force, bulk[k].force);
    if (!std::isfinite(radius) || !std::isfinite(cells.moment[k].capsule)) continue;
    sum += radius - cells.moment[k].capsule;
    ++n;
  }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace acinus::calibration
