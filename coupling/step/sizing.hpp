#pragma once
/// Size of a workspace: blocks of the system, their owners, and all arrays of a step.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Sizes everything for the present set of cells. To be called after the set changed and before
/// the first step.
void size_workspace(const World& world, Workspace& work);

}  // namespace acinus::coupling
