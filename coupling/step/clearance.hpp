#pragma once
/// Clearance of cells for rigid displacement.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Own deformable cell that moves as a whole.
struct MovedCell {
  std::size_t lane = 0;
  double distance = 0;  ///< um
};

/// Tests that nothing comes within contact range of a cell displaced by its distance in any
/// direction, even if all others move as far. Each process tests its own cells. Collective where
/// the work is shared.
/// @return [cell] 1: nothing does
std::vector<std::uint8_t> find_clear(const World& world, const Workspace& work,
                                     std::span<const MovedCell> cells);

}  // namespace acinus::coupling
