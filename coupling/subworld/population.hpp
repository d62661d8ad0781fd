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
/// @param self  process whose cells have points where not every process has those of all;
///              null: all given cells have points
State compose(std::span<const SelectedCell<State>> dcm, std::span<const SelectedCell<State>> cbm,
              const State& like, std::vector<std::size_t>* lane = nullptr,
              const Ranks* self = nullptr);

/// List of all cells of a state.
std::vector<SelectedCell<State>> list_dcm(const State& state);
std::vector<SelectedCell<State>> list_cbm(const State& state);

/// Replaces removed cells by fresh ones and sorts along a space-filling curve, which keeps
/// neighbours close in memory. Points of the others are copied by processes that hold them; near
/// cells are not known afterwards. Collective.
/// @param gone   [dcm lanes, then cbm cells] 1: removed
/// @param type   [same] new type of a kept cell; -1 or empty: unchanged
/// @param fresh  states that hold the new cells
void exchange_cells(const Ranks& ranks, std::span<const std::uint8_t> gone,
                    std::span<const int> type, std::span<const State> fresh, State& state);

}  // namespace acinus::coupling
