#pragma once
/// Error estimate of a step from the change of velocity.

#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Norm of an error field, um: the larger of its rms and a fifth of its maximum over nodes. With
/// random motility the mean of every cell is left out: it is white noise, integrated exactly.
/// @param field  [n_row][3][lane] um
double error_norm(const World& world, const Workspace& work, std::span<const double> field);

/// Estimated error, um: half the change of velocity times the step. A first step is compared with
/// rest.
double estimate_error(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
