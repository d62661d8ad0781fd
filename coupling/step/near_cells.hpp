#pragma once
/// Near cells: cells of other processes that own cells may touch in the coming steps. With several
/// processes a process has the points of its own cells and of near ones only; State::near_set says
/// so.

#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Finds the near cells anew if cells have moved or grown too far since they were found, brings
/// their points, and returns the memory of points that are not near any more. Where a part of the
/// model reads all points in every step each process has all. Collective.
/// @pre hand_over_cells
void refresh_near_cells(World& world, Workspace& work);

/// Gathers the points of all cells on every process: before they are read as a whole. Collective.
void complete_points(World& world, Workspace& work);

/// Moves the points that this process has: all, or own and near ones. Collective.
/// @param by  [n_row][3][lane] um, of which own rows are read
void move_present_points(const Workspace& work, std::span<const double> by, State& state);

}  // namespace acinus::coupling
