#pragma once
/// Sizes of a workspace: blocks of the system, their owners, and all arrays of a step.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Sizes a workspace for the present set of cells. Call it after a change of the set and before the
/// first step.
void size_workspace(const World& world, Workspace& work);

}  // namespace acinus::coupling
