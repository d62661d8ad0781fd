#pragma once
/// Stage 1 of a step: reference sizes of cells and places of vessels.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Refreshes radii, rest shapes and strengths of cells, and the vessels of a flexible tree.
/// @param at   positions of the tree
/// @param end  s, clock time of the references; the end of the step follows growth without lag
void refresh_references(const World& world, const State& at, double end, Workspace& work);

}  // namespace acinus::coupling
