#pragma once
/// Changes of the set of cells: a new state composed of cells of others, for division, death and
/// subworlds (subworld.hpp).

#include <cstddef>
#include <span>
#include <vector>

#include "core/selected_cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Composes a state of cells in the given order, with all that belongs to each (position, last
/// move, contacts, cycle). Deformable cells are grouped by type and mesh. Clock, balance and
/// counters are those of `like`.
/// @param lane  [dcm] lane of each deformable cell in the result, or null. Spheres keep their order
State compose(std::span<const SelectedCell<State>> dcm, std::span<const SelectedCell<State>> cbm,
              const State& like, std::vector<std::size_t>* lane = nullptr);

/// Sorts members along a space-filling curve, which keeps neighbours close in memory.
void sort_by_place(std::vector<SelectedCell<State>>& dcm, std::vector<SelectedCell<State>>& cbm);

/// List of all cells of a state.
std::vector<SelectedCell<State>> list_dcm(const State& state);
std::vector<SelectedCell<State>> list_cbm(const State& state);

/// Replaces removed cells by fresh ones and sorts along the space-filling curve.
/// @param gone   [dcm lanes, then cbm cells] 1: removed
/// @param type   [same] new type of a kept cell; -1 or empty: unchanged
/// @param fresh  states that hold the new cells
void exchange_cells(std::span<const std::uint8_t> gone, std::span<const int> type,
                    std::span<const State> fresh, State& state);

}  // namespace acinus::coupling
