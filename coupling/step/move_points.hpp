#pragma once
/// Displacement of the unknowns of a state.

#include <cstddef>
#include <span>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Moves all unknowns.
/// @param by  [n_row][3][lane] um
void move_points(State& state, std::span<const double> by);

/// Moves some unknowns, of whole blocks.
/// @param first  index of by[0] in vectors [n_row][3][lane]
void move_points(State& state, std::size_t first, std::span<const double> by);

}  // namespace acinus::coupling
