#pragma once
/// Finds deformable cells whose mesh degenerates and gives them a better one (mesh_remedy.hpp).

#include <cstddef>
#include <vector>

#include "coupling/life/life_report.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Lanes of the cells with a suspicious mesh, ascending. One pass over their triangles, on all
/// threads.
/// @param only_young  only cells that have not forgotten the shape they were given
std::vector<std::size_t> find_suspicious(const State& state, bool only_young = false);

/// Checks all meshes if the last step crossed the time grid of life, else those of cells that have
/// not forgotten the shape they were born with, and mends what is suspicious. Daughters slide along
/// each other by up to the length of an edge while they settle; a triangle that collapses then
/// folds the cell within minutes. A mended cell has its old volume and the mean tension of its old
/// surface: its cortex takes the new mesh for rest and forgets that within an hour, as after a
/// division. It and its neighbours then settle while all others stand still. What cannot be mended
/// is left as it is and named once a grid interval. Nothing at all changes while all meshes are
/// sound. The workspace is sized anew when a cell was mended.
void mend_meshes(World& world, Workspace& work, LifeReport& report);

}  // namespace acinus::coupling
