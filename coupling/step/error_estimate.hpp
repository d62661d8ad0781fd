#pragma once
/// How far a step is off, from the change of velocity.

#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Size of an error field, um: the larger of the rms and a fifth of the maximum over nodes. With
/// random motility every cell's mean is left out: it is white noise, which is integrated exactly.
/// @param field [n_row][3][lane] um
double error_norm(const World& world, const Workspace& work, std::span<const double> field);

/// Error estimate, um: half the change of velocity times the step. A first step is compared with
/// rest.
double estimate_error(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
