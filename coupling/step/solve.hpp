#pragma once
/// Stage 6: the displacement of a step from the assembled system.

#include <span>

#include "core/error.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Solves with the system's own forces as right-hand side and the last step's velocity as first
/// guess. Adds to cg_iterations, as all do here.
Status solve_step(const World& world, double step, Workspace& work, int& cg_iterations);

/// The same after the system changed, with the displacement found before as first guess.
Status solve_again(const World& world, Workspace& work, int& cg_iterations);

/// Solves for work.move from the guess it holds and the right-hand side in work.rhs, then puts the
/// rigid motion of every cluster right.
/// @param product  the matrix times the guess if it is known, else empty
Status solve_system(const World& world, Workspace& work, int& cg_iterations,
                    std::span<const double> product = {});

}  // namespace acinus::coupling
