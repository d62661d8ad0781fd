#pragma once
/// Cells that take part in a step but do not follow from its balance of forces: they stand still or
/// go on with a prescribed velocity, and what touches them feels them there. Forces within such a
/// cell are not computed.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace acinus::coupling {

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

}  // namespace acinus::coupling
