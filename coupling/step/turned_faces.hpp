#pragma once
/// Faces that a displacement would invert.

#include <cstddef>
#include <span>

#include "dcm/state.hpp"

namespace acinus::coupling {

/// True if a displacement inverts a face of the cortex or the nucleus of a cell, or nearly, or
/// folds two faces of an edge through each other.
/// @param move  [row][3][lane] um
bool turns_over(const dcm::State& state, std::size_t lane, std::span<const double> move);

}  // namespace acinus::coupling
