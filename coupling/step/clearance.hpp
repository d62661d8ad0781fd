#pragma once
/// How free a cell is to move as a whole.

#include <cstddef>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Whether nothing comes within the range of contact of a deformable cell that moves by `distance`
/// um in any direction, even if everything else moves as far.
/// @param body  number in work.dcm.body
bool is_clear(const World& world, const Workspace& work, std::size_t body, double distance);

}  // namespace acinus::coupling
