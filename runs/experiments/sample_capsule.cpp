#include <cmath>
#include <limits>

#include "calibration/clump.hpp"
#include "runs/experiments/experiment.hpp"

namespace acinus::runs {

void sample_capsule(const Scene&, const coupling::World& world, const Snapshot& s, Measures& m) {
  if (s.cells.empty()) return;
  const std::vector<contact::Capsule>& capsules = world.params.boundary.capsules;
  double radius = std::numeric_limits<double>::quiet_NaN();
  Vec3 center = Vec3::Zero();
  if (!capsules.empty()) {
    center = capsules.front().center;
    const double r = capsules.front().radius_at(s.time);
    if (std::isfinite(r)) radius = r;
  }
  const calibration::ClumpSample c =
      calibration::measure_clump(s.cells, calibration::find_central_cell(s.cells, center));
  m["capsule_radius_um"].push_back(radius);
  m["overlap"].push_back(c.overlap);
  m["shell_overlap"].push_back(c.shell_overlap);
  m["contact_force_nN"].push_back(c.contact_force);
  m["normal_force_nN"].push_back(c.force);
  m["contacts"].push_back(c.contacts);
  m["pressure_Pa"].push_back(1e3 * c.pressure);
  m["volume_relative"].push_back(c.volume);
}

}  // namespace acinus::runs
