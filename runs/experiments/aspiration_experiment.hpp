#pragma once
/// Aspiration of a cell into a micropipette.

#include <optional>

#include "runs/experiments/measures.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Suction at which the cell reaches in by the radius of the pipette beyond its lip, kPa, from the
/// series; none if it did not get there.
std::optional<double> critical_suction(const PipetteBlock& pipette, const Measures& measures);

/// Critical suction of a surface of constant tension, kPa: 2 T (1/R_p - 1/R_c), R_c being the
/// radius of the rest of the cell when half a ball of the volume is in the pipette.
double closed_form_suction(double tension, double pipette_radius, double cell_radius);

}  // namespace acinus::runs
