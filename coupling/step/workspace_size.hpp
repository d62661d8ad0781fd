#pragma once
/// Sizes of a workspace: blocks of the system, their owners, and all arrays of a step.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Sizes a workspace for the present set of cells. Call it after a change of the set and before the
/// first step.
void size_workspace(const World& world, Workspace& work);
/// Sizes a workspace, and hands the contacts of spheres and the last moves of cells over to their
/// new owners. Collective.
void size_workspace(World& world, Workspace& work);

/// Sizes what contacts need: their search begins anew with the present set of cells.
void begin_contacts(const World& world, Workspace& work);

/// Frees the vectors that a step makes anew for its solve, as room for other states of the cells,
/// and gaps between small arrays.
void release_solve(Workspace& work);
/// Frees these and the scratch of products, as room for a frame: what is written is then the only
/// large thing besides contacts and matrix.
void release_scratch(Workspace& work);

}  // namespace acinus::coupling
