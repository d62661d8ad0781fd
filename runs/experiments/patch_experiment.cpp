/// Experiment "patch": a box cut in two halves across x, one of each model.
///
/// Pressure is the mean contact pressure of the cells of a half; density is their number per volume
/// between the walls on their side of the plane midway between the innermost layers of the two
/// models.

#include <algorithm>
#include <limits>
#include <string>

#include "runs/experiments/experiment.hpp"

namespace acinus::runs {
namespace {

/// Box between the walls at a time, clipped by every plane that faces along an axis.
struct WallBox {
  Vec3 low = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::infinity());
};
WallBox wall_box(const contact::Boundary& boundary, double time) {
  WallBox box;
  for (const contact::Plane& p : boundary.planes)
    for (int k = 0; k < 3; ++k) {
      if (p.normal[k] > 0.999) box.low[k] = std::max(box.low[k], p.point_at(time)[k]);
      if (p.normal[k] < -0.999) box.high[k] = std::min(box.high[k], p.point_at(time)[k]);
    }
  return box;
}

/// Mean x of the cells of one model within one radius of that model's extreme cell.
double innermost_layer(const Snapshot& s, bool deformable, double sign) {
  double extreme = -std::numeric_limits<double>::infinity(), radius = 0;
  for (const coupling::CellMeasure& c : s.cells)
    if (c.deformable == deformable && sign * c.center.x() > extreme) {
      extreme = sign * c.center.x();
      radius = c.radius;
    }
  double sum = 0;
  int n = 0;
  for (const coupling::CellMeasure& c : s.cells)
    if (c.deformable == deformable && sign * c.center.x() > extreme - radius) {
      sum += c.center.x();
      ++n;
    }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Observable> patch_columns() {
  return {{"box_length_um", "um", "distance of the walls across x"},
          {"pressure_dcm_Pa", "Pa", "mean contact pressure of the deformable half; 0 without any"},
          {"pressure_cbm_Pa", "Pa", "mean contact pressure of the half of spheres; 0 without any"},
          {"density_dcm_per_mm3", "1/mm^3", "density of the deformable half; 0 without any"},
          {"density_cbm_per_mm3", "1/mm^3", "density of the half of spheres; 0 without any"}};
}

void sample_patch(const ObservedFrame& frame, ObservedRun& observed) {
  const Snapshot& s = frame.snapshot;
  Measures& m = observed.measures;
  double mean_x[2] = {0, 0}, pressure[2] = {0, 0};
  int count[2] = {0, 0};
  for (const coupling::CellMeasure& c : s.cells) {
    const int k = c.deformable ? 0 : 1;
    mean_x[k] += c.center.x();
    pressure[k] += c.pressure;
    ++count[k];
  }
  if (count[0] == 0 && count[1] == 0) return;
  const WallBox box = wall_box(frame.world.params.boundary, std::max(0.0, s.time));
  const double area = (box.high.y() - box.low.y()) * (box.high.z() - box.low.z());
  m["box_length_um"].push_back(box.high.x() - box.low.x());
  double middle = 0.5 * (box.low.x() + box.high.x());
  const bool both = count[0] > 0 && count[1] > 0;
  const bool dcm_left = !both || mean_x[0] / count[0] < mean_x[1] / count[1];
  if (both)
    middle = 0.5 * (innermost_layer(s, true, dcm_left ? 1 : -1) +
                    innermost_layer(s, false, dcm_left ? -1 : 1));
  for (int k = 0; k < 2; ++k) {
    if (count[k] == 0) continue;
    const bool left = (k == 0) == dcm_left;
    const double length = !both  ? box.high.x() - box.low.x()
                          : left ? middle - box.low.x()
                                 : box.high.x() - middle;
    const std::string name = k == 0 ? "dcm" : "cbm";
    m["pressure_" + name + "_Pa"].push_back(1e3 * pressure[k] / count[k]);
    m["density_" + name + "_per_mm3"].push_back(1e9 * count[k] / (length * area));
  }
}

}  // namespace

const ExperimentRow patch_experiment{
    .meaning = "pressure and density of both models in the two halves of a box",
    .columns = patch_columns,
    .sample = sample_patch,
    .reads_snapshot_only = true};

}  // namespace acinus::runs
