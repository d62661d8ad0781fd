#include <algorithm>
#include <cmath>
#include <limits>

#include "runs/experiments/experiment.hpp"

namespace acinus::runs {

void sample_lobule(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                   Measures& m) {
  const double height = scene.lobule ? scene.lobule->height : 48;
  const double cell_radius = scene.cell_types.begin()->second.radius;
  const int n_layer = std::max(1, static_cast<int>(std::lround(height / (2 * cell_radius))));
  std::vector<double> nearest(static_cast<std::size_t>(n_layer),
                              std::numeric_limits<double>::infinity());
  double pressure = 0;
  for (const coupling::CellMeasure& c : snapshot.cells) {
    const int layer = std::clamp(static_cast<int>(c.center.z() / height * n_layer), 0, n_layer - 1);
    double& r = nearest[static_cast<std::size_t>(layer)];
    r = std::min(r, (c.center - scene.axis_point).head<2>().norm());
    pressure += c.pressure;
  }
  double sum = 0;
  int counted = 0;
  for (double r : nearest)
    if (std::isfinite(r)) {
      sum += r;
      ++counted;
    }
  const double radius = counted > 0 ? sum / counted : 0;
  const double floor = world.params.motility.axis_radius + cell_radius;
  std::vector<double>& radii = m["lesion_radius_um"];
  radii.push_back(radius);
  const double open = std::max(radius - floor, 0.0) / std::max(radii.front() - floor, 1e-9);
  m["time_d"].push_back(snapshot.time / 86400);
  m["cells"].push_back(static_cast<double>(snapshot.cells.size()));
  m["lesion_area_relative"].push_back(open * open);
  m["mean_pressure_Pa"].push_back(1e3 * pressure /
                                  std::max<double>(1, static_cast<double>(snapshot.cells.size())));
}

}  // namespace acinus::runs
