#pragma once
/// Constrained cells of a step: at rest or with a prescribed velocity, independent of their balance
/// of forces. Their contacts act on others; forces within them are not computed.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace acinus::coupling {

struct Constraint {
  /// [dcm lanes, then cbm cells] 1: constrained; empty: none. Set before size_workspace.
  std::vector<std::uint8_t> cell;
  /// True if constrained cells keep the velocity of their last move (linearly implicit steps only);
  /// else they are at rest.
  bool prescribed_velocity = false;
  /// Rows of anchored vessels, in their first lane; written by: size_workspace.
  std::vector<std::size_t> anchored_row;

  bool applies() const { return !cell.empty(); }
  bool holds(std::size_t lane) const { return lane < cell.size() && cell[lane] != 0; }
};

}  // namespace acinus::coupling
