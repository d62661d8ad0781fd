#pragma once
/// Changes of the set of cells: a new state made of cells of others. Division, death and the small
/// worlds cut out of large ones (subworld.hpp) all come down to it.

#include <cstddef>
#include <span>
#include <vector>

#include "core/selected_cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// A state with these cells in this order and everything that belongs to each of them (position,
/// last movement, contacts that exist, cycle). Deformable cells are grouped by type and mesh.
/// Clock, balance and counters are those of `like`.
/// @param lane  [dcm] where each deformable cell came to stand; null: not wanted. Spheres keep
///              their order
State compose(std::span<const SelectedCell<State>> dcm, std::span<const SelectedCell<State>> cbm,
              const State& like, std::vector<std::size_t>* lane = nullptr);

/// Sorts the members along a space-filling curve, so that neighbours stand near each other in
/// memory.
void sort_by_place(std::vector<SelectedCell<State>>& dcm, std::vector<SelectedCell<State>>& cbm);

/// All cells of a state.
std::vector<SelectedCell<State>> list_dcm(const State& state);
std::vector<SelectedCell<State>> list_cbm(const State& state);

/// Puts fresh cells in the place of those that are gone, neighbours near each other.
/// @param gone   [dcm lanes, then cbm cells] 1: this cell leaves
/// @param type   [same] what a cell that stays becomes; -1 or an empty list: it stays what it is
/// @param fresh  states that hold the new cells
void exchange_cells(std::span<const std::uint8_t> gone, std::span<const int> type,
                    std::span<const State> fresh, State& state);

}  // namespace acinus::coupling
