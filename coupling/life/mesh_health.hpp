#pragma once
/// Detection and repair of degenerate meshes (mesh_remedy.hpp).

#include <cstddef>
#include <vector>

#include "coupling/life/life_report.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Finds lanes with a suspicious mesh, ascending. One pass over all triangles, on all threads.
/// @param only_young  true: only cells that still relax from a given shape
std::vector<std::size_t> find_suspicious(const State& state, bool only_young = false);

/// Checks meshes and repairs suspicious ones. All cells are checked if the last step crossed the
/// time grid of life, else only cells that still relax from their shape of birth: settling
/// daughters slide along each other by up to an edge length, and a collapsed triangle folds the
/// cell within minutes.
///
/// A repaired cell keeps its volume and the mean tension of its surface. The new mesh becomes the
/// rest shape of the cortex, which relaxes from it within an hour, as after a division. The cell
/// and its neighbours settle with all others fixed. A mesh that cannot be repaired is unchanged and
/// reported once per grid interval. Nothing changes while all meshes are sound. Sizes the workspace
/// anew after a repair.
void mend_meshes(World& world, Workspace& work, LifeReport& report);

}  // namespace acinus::coupling
