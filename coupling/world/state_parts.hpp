#pragma once
/// Arrays of a state in parts. With several processes some numbers of a cell are with its holder
/// only (State::cell_holder, State::holder); the root gets them a few MB at a time.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "coupling/world/world.hpp"
#include "io/array_source.hpp"

namespace acinus::coupling {

/// Points of a lane; lanes count [dcm lanes, then those of the rows of spheres].
inline int points_of(const State& s, std::size_t lane) {
  return lane < s.dcm.n_lane() ? s.dcm.group[lane / kLanes].n_point() : 1;
}

/// Address of the first point of a lane among all unknowns.
inline Address first_point_of(const State& s, std::size_t lane) {
  return lane < s.dcm.n_lane() ? dcm::node_address(s.dcm, lane, 0)
                               : cbm::cell_address(s.dcm.n_row(), lane - s.dcm.n_lane());
}

/// Calls f(k) for the indices k of a lane's numbers in vectors [n_row][3][lane].
template <class F>
void for_each_number_of(const State& s, std::size_t lane, const F& f) {
  const auto first = static_cast<std::size_t>(first_point_of(s, lane));
  const auto n = static_cast<std::size_t>(points_of(s, lane));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t m = 0; m < 3; ++m) f(first + i * kPointStride + m * kLanes);
}

/// Number k of the points of a state, as for_each_number_of counts.
inline double& number_of(State& s, std::size_t k) {
  return *position_of(s, static_cast<Address>(k));
}
inline double number_of(const State& s, std::size_t k) {
  return *position_of(s, static_cast<Address>(k));
}

/// Lanes [first, end), as points_of() counts them.
struct LaneRange {
  std::size_t first = 0, end = 0;
};
inline LaneRange shell_lanes(const State& s) { return {0, s.dcm.n_lane()}; }
/// Lanes of spheres, without empty ones.
inline LaneRange sphere_lanes(const State& s) {
  return {s.dcm.n_lane(), s.dcm.n_lane() + s.cbm.n_cell()};
}

using TakeNumbers = io::TakePart<double>;

/// Numbers of lanes, which their holders have. Collective if cells have holders.
/// @param append  append(lane, out) adds the numbers of a lane that this process holds
/// @param take    take(lane, numbers), at the root: all lanes of the range in their order
void visit_lanes(const Ranks& ranks, const State& state, LaneRange range,
                 const std::function<void(std::size_t, std::vector<double>&)>& append,
                 const std::function<void(std::size_t, std::span<const double>)>& take);

/// Positions of all rows of deformable cells [n_row][3][lane], at the root. Collective likewise.
void visit_shell_positions(const Ranks& ranks, const State& state, const TakeNumbers& take);
/// Positions of all rows of spheres, likewise.
void visit_sphere_positions(const Ranks& ranks, const State& state, const TakeNumbers& take);
/// Displacements of the last step, State::last_move, likewise.
void visit_last_move(const Ranks& ranks, const State& state, const TakeNumbers& take);

/// Number of pairs in cbm::State::touching of all processes together. Collective.
std::size_t count_touching(const Ranks& ranks, const State& state);
/// Pairs in cbm::State::touching of all processes, sorted, at the root. Collective.
void visit_touching(const Ranks& ranks, const State& state,
                    const std::function<void(std::span<const std::pair<int, int>>)>& take);

/// Hash of the whole state in storage order, at the root; others get another value. Equal bits give
/// equal hashes for any number of processes. Collective if cells have holders.
std::uint64_t hash_state(const Ranks& ranks, const State& state);

}  // namespace acinus::coupling
