#pragma once
/// Last moves and shapes of birth, which with several processes are with the owners of the cells:
/// State::cell_holder names them. Numbers of others are zero, or not there.

#include <cstddef>
#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Keeps the displacements of own cells in a step, work.move: all that State::last_move holds
/// where cells have holders.
void keep_own_moves(const Workspace& work, State& state);

/// Hands cells over to their present owners; does nothing if these have them. Every process keeps
/// all if it does all work, if cells are constrained, and with explicit Euler. Collective.
/// @pre the blocks of the system are those of the state
void hand_over_cells(World& world, const Workspace& work);

/// Gathers all cells on every process: before they are read as a whole. Collective.
void complete_cells(const Ranks& ranks, State& state);

/// Gathers all cells at the root, before a state is written; holders stay. Collective.
void bring_cells_to_root(const Ranks& ranks, State& state);
/// Returns the memory of what other processes hold.
void drop_cells(const Ranks& ranks, State& state);

/// Gathers the shapes of birth of some deformable cells on every process. Collective.
void complete_shapes(const Ranks& ranks, std::span<const std::size_t> lanes, State& state);

}  // namespace acinus::coupling
