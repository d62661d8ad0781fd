#pragma once
/// Displacement of all unknowns of a state.

#include <span>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Moves all unknowns.
/// @param by  [n_row][3][lane] um
void move_points(State& state, std::span<const double> by);

}  // namespace acinus::coupling
