#pragma once
/// Stability of explicit Euler, (Gamma/h) dx = F(x; t), the friction solve of [VanLiedekerke2020],
/// of order 1.

#include "core/error.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Fails if the shapes of cells oscillate without decay: the step is beyond the limit of stability.
/// @pre the step was solved
[[nodiscard]] Status check_stability(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
