#pragma once
/// Stability check of explicit Euler, (Gamma/h) dx = F(x; t), of first order, the friction solve of
/// [VanLiedekerke2020].

#include "core/error.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Check that cell shapes do not oscillate without decay, as beyond the limit of stability.
/// @pre the step was solved
[[nodiscard]] Status check_stability(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
