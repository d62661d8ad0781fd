#pragma once
/// Points of constrained cells and anchored vessels within a step.

#include <span>

#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Marks constrained deformable cells for contacts and internal forces.
void apply_constraints(Workspace& work);

/// Adds a penalty stiffness to the diagonal of every constrained point.
void add_constraint(double step, Workspace& work);

/// Subtracts the contribution of add_constraint from the product of the assembled matrix with
/// `move`.
void remove_constraint(const Workspace& work, std::span<const double> move,
                       std::span<double> product);

/// Sets the displacement of constrained points to its prescribed value.
/// @param move  [n_row][3][lane] um; empty: zero
void place_constrained(std::span<const double> move, Workspace& work);

}  // namespace acinus::coupling
