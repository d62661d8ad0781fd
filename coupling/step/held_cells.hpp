#pragma once
/// Last moves, shapes of birth and points of cells, which with several processes are with the
/// owners of the cells: State::cell_holder names them. Numbers of others are zero, or not there.
/// Points are with near processes too (near_cells.hpp).

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/parallel/threads.hpp"
#include "coupling/world/state_parts.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Completes a plan in which each process knows the runs that it sends: gets the lengths of those
/// that it receives, and places them one after the other. Both ends list each other.
/// @return length of the receive buffer
std::size_t exchange_lengths(const Ranks& ranks, ExchangePlan& plan);

/// Keeps the displacements of own cells in a step, work.move: all that State::last_move holds
/// where cells have holders.
void keep_own_moves(const Workspace& work, State& state);

/// Hands cells over to their present owners; does nothing if these have them. Every process keeps
/// all if it does all work, if cells are constrained, and with explicit Euler. Collective.
/// @pre the blocks of the system are those of the state
void hand_over_cells(World& world, const Workspace& work);

/// Numbers of a cell that near processes have.
std::size_t count_near_numbers(const State& state, std::size_t lane);
void pack_near(const State& state, std::size_t lane, std::vector<double>& out);
/// Reads what pack_near() wrote.   @return end of it
const double* unpack_near(const double* from, std::size_t lane, State& state);

/// Gathers them of all cells on every process. Collective.
void complete_near(const Ranks& ranks, State& state);
/// Returns the memory of those of cells that are neither own nor near.
/// @param poison  true: they become NaN instead, to test that no result depends on them
void drop_far(const Ranks& ranks, State& state, bool poison);

/// Gathers all cells on every process: before they are read as a whole. Collective.
void complete_cells(const Ranks& ranks, State& state);

/// True if this process has the points of a cell in a state whose near cells are not known.
inline bool holds_points(const Ranks& ranks, const State& s, std::size_t lane) {
  return s.near_set == 0 || s.cell_holder[lane] == ranks.rank() ||
         s.cell_holder[lane] == kEverywhere;
}

/// Gathers a place of each lane from its holder. Collective if points are not everywhere.
/// @param place_of  place_of(lane), um, of a lane with points
/// @return          [lanes of all rows of cells]
template <class F>
std::vector<Vec3> gather_places(const Ranks& ranks, const State& s, const F& place_of) {
  const std::size_t n = s.dcm.n_lane() + s.cbm.n_row() * kLanes;
  std::vector<Vec3> own, all(s.near_set == 0 ? n : 0);
  for_each_index(all.size(), worth_threads(n), [&](std::size_t k) { all[k] = place_of(k); });
  if (s.near_set == 0) return all;
  const auto owner = [&s](std::size_t k) { return std::max(0, s.cell_holder[k]); };
  for (std::size_t k = 0; k < n; ++k)
    if (owner(k) == ranks.rank()) own.push_back(place_of(k));
  solve::gather_in_order(
      ranks, n, owner, [](std::size_t) { return std::size_t{1}; }, own, all);
  return all;
}

/// Gathers the points of some cells on every process, which keep them until near cells are found.
/// Collective.
void bring_points(const Ranks& ranks, std::span<const std::size_t> lanes, State& state);

/// Makes a state one whose near cells are not known, unless every process has all points.
void forget_near(State& state);

/// Gathers the shapes of birth of some deformable cells on every process. Collective.
void complete_shapes(const Ranks& ranks, std::span<const std::size_t> lanes, State& state);

}  // namespace acinus::coupling
