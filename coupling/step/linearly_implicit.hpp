#pragma once
/// Linearly implicit Euler: (Gamma/h + K) dx = F(x; t + h), order 1.

#include "coupling/step/attempt.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// With `extrapolate` F and K are taken at x + h v of the last step, which takes the lag out of
/// steady motion (docs/decisions/0016.md); not after a jump of the random force, whose velocity is
/// gone. Contacts that close within the step are treated there (closing.hpp) if the step size is
/// controlled.
Attempt try_linearly_implicit(World& world, double step, bool extrapolate, Workspace& work);

}  // namespace acinus::coupling
