#pragma once
/// Explicit Euler: (Gamma/h) dx = F(x; t), the friction solve of [VanLiedekerke2020], order 1.

#include "coupling/step/attempt.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Fails where the shapes of cells oscillate without dying down: the step is beyond the limit of
/// stability.
Attempt try_explicit_euler(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
