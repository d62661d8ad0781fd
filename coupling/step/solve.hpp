#pragma once
/// Stage 6 of a step: the displacement of all cells from the assembled system.

#include <span>

#include "core/error.hpp"
#include "coupling/step/effort.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Solves with the forces of the system as right-hand side (warm start). The initial guess is the
/// displacement to the point of linearisation, else that of the last step's velocity. All functions
/// of this file add to `effort`.
[[nodiscard]] Status solve_step(const World& world, double step, Workspace& work, Effort& effort);

/// Solves again after changes of a few links, from the previous displacement. Without constrained
/// cells goes on from the residual, with the coarse space of before.
/// @pre work.op, work.rhs and work.cg.residual are up to date
[[nodiscard]] Status solve_again(const World& world, Workspace& work, Effort& effort);

/// Solves for work.move from its initial guess and the right-hand side in work.rhs, then corrects
/// the rigid motion of every cluster.
[[nodiscard]] Status solve_system(const World& world, Workspace& work, Effort& effort);

}  // namespace acinus::coupling
