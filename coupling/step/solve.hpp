#pragma once
/// Stage 6 of a step: the displacement of all cells from the assembled system.

#include <span>

#include "core/error.hpp"
#include "coupling/step/effort.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Solves with the system's own forces as right-hand side. The initial guess is the displacement
/// to the point of linearisation, or else that with the last step's velocity. All functions here
/// add to `effort`.
[[nodiscard]] Status solve_step(const World& world, double step, Workspace& work, Effort& effort);

/// Solves once more after the system changed, with the displacement found before as initial guess.
[[nodiscard]] Status solve_again(const World& world, Workspace& work, Effort& effort);

/// Solves for work.move from the guess it holds and the right-hand side in work.rhs, then corrects
/// the rigid motion of every cluster.
/// @param product  the matrix times the guess if it is known, else empty
[[nodiscard]] Status solve_system(const World& world, Workspace& work, Effort& effort,
                                  std::span<const double> product = {});

}  // namespace acinus::coupling
