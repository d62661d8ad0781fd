/// Experiment "capsule": a clump in a capsule that shrinks and may open.
///
/// Measured are the capsule's radius and the cell nearest its centre (without a capsule: nearest
/// the origin): its relative overlap d (cbm::relative_overlap), the mean d of its 14 nearest cells,
/// contact forces, pressure and volume.

#include "runs/experiments/capsule_experiment.hpp"

#include <cmath>

#include "calibration/clump.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

std::vector<Observable> capsule_columns() {
  return {
      {"capsule_radius_um", "um", "radius of the capsule; 0 once it is open"},
      {"overlap", "1", "relative overlap d of the cell nearest the centre"},
      {"shell_overlap", "1", "mean d of the 14 cells nearest to that cell"},
      {"contact_force_nN", "nN", "sum of the magnitudes of the contact forces on the central cell"},
      {"normal_force_nN", "nN",
       "sum of the normal forces on the central cell, compression positive"},
      {"contacts", "1", "cells in contact with the central cell"},
      {"pressure_Pa", "Pa", "contact pressure of the central cell"},
      {"volume_relative", "1", "volume of the central cell over its reference volume"}};
}

void sample_capsule(const ObservedFrame& frame, ObservedRun& observed) {
  const Snapshot& s = frame.snapshot;
  Measures& m = observed.measures;
  if (s.cells.empty()) return;
  const std::vector<contact::Capsule>& capsules = frame.world.params.boundary.capsules;
  double radius = kNotMeasured;
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

}  // namespace

bool is_capsule_compression(const Scene& scene) {
  return scene.experiment == Experiment::kCapsule && scene.capsule.enabled;
}

const ExperimentRow capsule_experiment{
    .meaning = "compression of a clump in a capsule that shrinks",
    .columns = capsule_columns,
    .sample = sample_capsule};

}  // namespace acinus::runs
