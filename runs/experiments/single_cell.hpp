#pragma once
/// Experiments on one or two deformable cells that need more than a snapshot: between plates, at a
/// pipette, in a narrow gap, pulled apart.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/observed_frame.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Value of an observable in a frame without the cell it is measured on.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// A cell between two plates, the scene's walls: gap_um between them, force_nN (normal force on a
/// plate, mean of the two), contact_radius_um (that of a circle with the area that touches a plate,
/// mean of the two), cytosol_pressure_Pa, and shell_force_nN, what shell_force says.
void sample_plates(const ObservedFrame& frame, Measures& measures);

/// Force that compresses a thin shell which keeps its volume, nN: of the area that grows, as far as
/// the tension is the same everywhere, and of the shell that is flattened,
///   F = 2 pi (K + K_A) R e^3 + 8 sqrt(Y kappa) e,   e = 1 - gap / 2R
/// with K = (sqrt 3 / 2) k_s, Y = (2/sqrt 3) k_s, kappa = (sqrt 3 / 2) k_b of the net
/// (docs/models.md says where it holds).
double shell_force(const dcm::Params& cell, double radius, double gap);

/// A cell at a pipette that sucks: suction_Pa and aspirated_length_um, how far the cell reaches
/// beyond the plane of the mouth.
void sample_aspiration(const ObservedFrame& frame, Measures& measures);

/// Suction at which the cell reaches in by the radius of the pipette beyond its lip, kPa, from the
/// series; none if it did not get there.
std::optional<double> critical_suction(const PipetteBlock& pipette, const Measures& measures);

/// What it is for a surface of constant tension, kPa: 2 T (1/R_p - 1/R_c), R_c being the radius of
/// the rest of the cell when half a ball of the volume is in the pipette.
double closed_form_suction(double tension, double pipette_radius, double cell_radius);

/// A cell that is driven through the hole of a pipette of some length: position_um (of its centre,
/// along the axis from the mouth), length_um and width_um (extent along the axis and, mean, across
/// it), waist_um (diameter of the circle as large as its section halfway through the hole; 0 if it
/// is not there) and passed (1 once all of it is beyond the far end).
void sample_narrow_gap(const ObservedFrame& frame, Measures& measures);

/// From when the cell first reaches into the hole to when it has passed, h; none if it has not.
std::optional<double> passage_time(const Measures& measures);

/// Two cells that adhere and are pulled apart (the scene's first two pulls): pull_force_nN (mean of
/// the two), pull_force_relative (over vesicle_pull_off), distance_um of their centres,
/// contact_area_um2 and contact_radius_um (coupling/measure/adhesion.hpp), tension_outside_mN_m
/// (mean over the nodes out of contact), tension_contact_mN_m and tension_contact_min_mN_m (mean
/// and least of those in contact; none without contact).
void sample_pull_off(const ObservedFrame& frame, Measures& measures);

/// Reduced radius R1 R2 / (R1 + R2), um, and adhesion energy, nN/um, of the two cells of a scene.
struct PairOfCells {
  double reduced_radius = 0, adhesion = 0;
};
PairOfCells pair_of(const Scene& scene);

/// Force that parts two vesicles, nN: pi W R^. JKR is 3/2 of it, DMT 2.
/// [VanLiedekerke2020, Eq. (24)]
double vesicle_pull_off(const PairOfCells& pair);

/// The largest force that the pair bore, nN, from the series; none if it did not come apart.
std::optional<double> pull_off_force(const Measures& measures);

/// Whether cells that were in contact have come apart.
bool has_come_apart(const Measures& measures);

/// Nodes of the first deformable cell; empty if there is none.
std::vector<Vec3> first_cell(const coupling::World& world);

/// Extent of points along a direction, and the mean over 36 directions across an axis, um.
double extent(std::span<const Vec3> points, const Vec3& direction);
double extent_across(std::span<const Vec3> points, const Vec3& axis);

}  // namespace acinus::runs
