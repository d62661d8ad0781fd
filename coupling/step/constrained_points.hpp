#pragma once
/// Points of constrained cells and anchored vessels within a step.

#include <span>

#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Tells contacts and forces within cells which deformable cells are constrained.
void apply_constraints(Workspace& work);

/// Ties every constrained point to its place: a diagonal entry so large that it does not move.
void add_constraint(double step, Workspace& work);

/// Takes out of the product of the assembled matrix with `move` what add_constraint added to it.
void remove_constraint(const Workspace& work, std::span<const double> move,
                       std::span<double> product);

/// Constrained points go exactly where they have to, whatever the solver found.
/// @param move  [n_row][3][lane] um; empty: they stay where they are
void place_constrained(std::span<const double> move, Workspace& work);

}  // namespace acinus::coupling
