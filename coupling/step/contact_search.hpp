#pragma once
/// Stage 3 of a step: all contacts of the cells of both models with each other and with boundaries.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Refreshes outdated neighbour lists, then finds all contacts.
/// @param at   positions of all cells
/// @param end  s, clock time of the positions of moving walls
/// @pre references and constraints are those of the step
void refresh_contacts(const World& world, const State& at, double end, Workspace& work);

}  // namespace acinus::coupling
