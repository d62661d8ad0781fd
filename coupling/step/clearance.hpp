#pragma once
/// Clearance of a cell for rigid displacement.

#include <cstddef>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// True if nothing comes within contact range of a deformable cell displaced by `distance`, um, in
/// any direction, even if all others move as far.
/// @param body  index in work.dcm.body
bool is_clear(const World& world, const Workspace& work, std::size_t body, double distance);

}  // namespace acinus::coupling
