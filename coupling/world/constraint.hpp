#pragma once
/// Cells that take part in a step but do not follow from its balance of forces: they stand still or
/// go on with a prescribed velocity, and what touches them feels them there. Forces within such a
/// cell are not computed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace acinus::coupling {

struct Workspace;

struct Constraint {
  /// [dcm lanes, then cbm cells] 1: constrained; empty: none. To be set before size_workspace.
  std::vector<std::uint8_t> cell;
  /// Constrained cells go on with the velocity of their last move, which linearly implicit steps
  /// only know how to do; else they stand still.
  bool prescribed_velocity = false;
  /// Rows of anchored vessels, in their first lane; written by: size_workspace.
  std::vector<std::size_t> anchored_row;

  bool applies() const { return !cell.empty(); }
  bool holds(std::size_t lane) const { return lane < cell.size() && cell[lane] != 0; }
};

/// Tells contacts and forces within cells which deformable cells are constrained.
void apply_constraint(Workspace& work);

/// Ties every constrained point to its place: a diagonal entry so large that it does not move.
void add_constraint(double step, Workspace& work);

/// Takes out of the product of the assembled matrix with `move` what add_constraint added to it.
void remove_constraint(const Workspace& work, std::span<const double> move,
                       std::span<double> product);

/// Constrained points go exactly where they have to, whatever the solver found.
/// @param move  [n_row][3][lane] um; empty: they stay where they are
void place_constrained(std::span<const double> move, Workspace& work);

}  // namespace acinus::coupling
