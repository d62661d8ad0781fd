#pragma once
/// Backward Euler, Gamma/h dx = F(x + dx; t + h), by Newton's method with line search, order 1.

#include "coupling/step/attempt.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The first iteration is a linearly implicit step.
Attempt try_newton(World& world, double step, Workspace& work);

}  // namespace acinus::coupling
