/// Experiment "plates": a cell between two plates, the walls of the scene.
///
/// Force, contact radius (that of a circle with the area in touch) are means of the two plates.

#include "runs/experiments/plates_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/measure/contact_forces.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

double gap_between(const contact::Plane& a, const contact::Plane& b, double time) {
  return a.normal.dot(b.point_at(time) - a.point_at(time));
}

void check_plates(const Scene& scene, Report& report) {
  check_one_deformable_cell(scene, report);
  constexpr double kOpposite = 1e-9;
  const std::vector<WallEntry>& w = scene.walls;
  const bool face =
      w.size() == 2 && (w[0].normal.normalized() + w[1].normal.normalized()).norm() < kOpposite;
  if (!face)
    report.add_relation({"/experiment", "/walls"}, "\"plates\"",
                        "needs two walls with opposite normals, the plates (acinus explain wall)");
}

std::vector<Observable> plates_columns() {
  return {
      {"gap_um", "um", "distance of the plates"},
      {"force_nN", "nN", "normal force on a plate, mean of the two"},
      {"contact_radius_um", "um",
       "radius of a circle with the area of contact with a plate, mean of the two"},
      {"cytosol_pressure_Pa", "Pa", "cytosol pressure of the cell"},
      {"shell_force_nN", "nN",
       "force on a thin shell of constant volume between plates at this distance (closed form)"}};
}

void sample_plates(const ObservedFrame& f, ObservedRun& observed) {
  Measures& m = observed.measures;
  const auto& cells = f.snapshot.cells;
  const std::vector<contact::Plane>& plane = f.world.params.boundary.planes;
  const bool there = plane.size() == 2 && !cells.empty() && cells.front().deformable;
  double gap = kNotMeasured, force = kNotMeasured, radius = kNotMeasured, pressure = kNotMeasured,
         shell = kNotMeasured;
  if (there) {
    const coupling::CellMeasure& cell = cells.front();
    const coupling::Reactions reactions = coupling::compute_reactions(f.world, f.work);
    coupling::Reaction both;
    for (const coupling::Reaction& r : reactions.of(contact::Partner::kPlane)) both += r;
    gap = gap_between(plane[0], plane[1], f.snapshot.time);
    force = both.normal / 2;
    radius = std::sqrt(both.area / 2 / kPi);
    pressure = 1e3 * cell.cytosol_pressure;
    shell = shell_force(f.world.params.dcm[cell.type], cell.radius, gap);
  }
  m["gap_um"].push_back(gap);
  m["force_nN"].push_back(force);
  m["contact_radius_um"].push_back(radius);
  m["cytosol_pressure_Pa"].push_back(pressure);
  m["shell_force_nN"].push_back(shell);
}

}  // namespace

double shell_force(const dcm::Params& cell, double radius, double gap) {
  const double e = std::max(0.0, 1 - gap / (2 * radius));
  const double root = std::sqrt(3.0), k = cell.spring_stiffness;
  const double young = 2 / root * k, modulus = root / 2 * k,
               bending = root / 2 * cell.bending_stiffness;
  return 2 * kPi * (modulus + cell.area_modulus) * radius * e * e * e +
         8 * std::sqrt(young * bending) * e;
}

const ExperimentRow plates_experiment{.meaning = "force and contact of a cell between two plates",
                                      .check = check_plates,
                                      .columns = plates_columns,
                                      .sample = sample_plates};

}  // namespace acinus::runs
