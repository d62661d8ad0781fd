#pragma once
/// Error estimate of a step from the change of velocity.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Estimated error, um: half the change of velocity times the step. A first step is compared with
/// rest.
double estimate_error(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
