#include "coupling/subworld/population.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/parallel/threads.hpp"
#include "coupling/generate/packing.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Value of a cell in another state, or a default where that state has none.
template <class Values, class T>
T value_of(const Values& values, std::size_t index, T otherwise) {
  return index < values.size() ? values[index] : otherwise;
}

/// Copies the last move of a point; zeros are there already and get no memory.
void copy_move(const State& from, Address at, State& to, Address place) {
  for (Address k = 0; k < 3 * kLanes; k += kLanes)
    if (std::bit_cast<std::uint64_t>(from.last_move[at + k]) != 0)
      to.last_move[place + k] = from.last_move[at + k];
}

/// Lane of a member among all rows of cells of its state.
std::size_t lane_of_member(const SelectedCell<State>& m, bool spheres) {
  return m.index + (spheres ? m.state->dcm.n_lane() : 0);
}

Vec3 center_of_lane(const State& s, std::size_t lane) {
  if (lane < s.dcm.n_lane())
    return s.dcm.active(lane) ? dcm::cell_center(s.dcm, lane) : Vec3::Zero();
  return load_point(position_of(s, first_point_of(s, lane)), 0);
}

/// Sorts members along a space-filling curve.
/// @param center_of_s  [lanes] um, of the cells of `s`; those of other states have their points
void sort_along_curve(std::vector<SelectedCell<State>>& members, bool spheres, const State& s,
                      std::span<const Vec3> center_of_s) {
  std::vector<Vec3> center;
  center.reserve(members.size());
  for (const SelectedCell<State>& m : members) {
    const std::size_t lane = lane_of_member(m, spheres);
    center.push_back(m.state == &s ? center_of_s[lane] : center_of_lane(*m.state, lane));
  }
  std::vector<SelectedCell<State>> sorted;
  sorted.reserve(members.size());
  for (int k : space_filling_order(center)) sorted.push_back(members[k]);
  members = std::move(sorted);
}

/// Gives a state room for the signals and the adhesion that another one has.
void size_signals(const State& like, std::size_t n_cell, State& s) {
  for (std::size_t k = 0; k < like.signal.value.size(); ++k) {
    s.signal.value.resize(like.signal.value.size());
    if (!like.signal.value[k].empty()) s.signal.value[k].resize(n_cell, 0.0);
  }
  if (!like.adhesion.empty()) s.adhesion.resize(n_cell, 1.0);
}

/// Copies them of one cell.   @pre size_signals
void copy_signals(const State& from, std::size_t at, State& s, std::size_t to) {
  for (std::size_t k = 0; k < from.signal.value.size(); ++k)
    if (!from.signal.value[k].empty()) s.signal.value[k][to] = from.signal.value[k][at];
  if (!from.adhesion.empty()) s.adhesion[to] = from.adhesion[at];
}

/// Gives fresh cells the measured signals and the adhesion that they had in another model, or that
/// their mother had.
void inherit_signals(std::span<const State> fresh, const State& before, State& s) {
  if (before.signal.value.empty() && before.adhesion.empty()) return;
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  size_signals(before, n_cell, s);
  const CellIndex then = index_cells(before), now = index_cells(s);
  for (const State& f : fresh)
    for_each_cell(f, [&](const Cell& c) {
      auto from = then.find(lineage_of(f, c));
      if (from == then.end() && c.index < f.cycle.size()) from = then.find(f.cycle[c.index].parent);
      if (from == then.end()) return;
      copy_signals(before, from->second.index, s, now.at(lineage_of(f, c)).index);
    });
}

/// [members] 1: the points of a cell are with another process; empty: of none.
std::vector<std::uint8_t> mark_absent(std::span<const SelectedCell<State>> members, bool spheres,
                                      const Ranks* self) {
  std::vector<std::uint8_t> absent;
  if (self == nullptr) return absent;
  for (const SelectedCell<State>& m : members)
    absent.push_back(holds_points(*self, *m.state, lane_of_member(m, spheres)) ? 0 : 1);
  return absent;
}

/// Gives a composed state all values of one cell that have no place in its model: leader, cycle,
/// change of model, guidance, signals, sleep and holder.
/// @param has_cycle  false: another process has it
/// @param holder     [dcm lanes, then lanes of spheres] holders of all cells; empty: none
void copy_values(const State& from, std::size_t at, bool has_cycle, const State& like, State& s,
                 std::size_t to, std::vector<int>& holder) {
  const std::size_t n_cell = s.leader.size();
  s.leader[to] = value_of(from.leader, at, std::uint8_t{0});
  if (has_cycle) s.cycle[to] = value_of(from.cycle, at, Cycle{});
  if (!from.model_since.empty()) {
    s.model_since.resize(n_cell, like.clock.origin);
    s.model_since[to] = from.model_since[at];
  }
  if (!from.cell_holder.empty()) {
    holder.resize(s.dcm.n_lane() + s.cbm.n_row() * kLanes, kEverywhere);
    holder[to] = from.cell_holder[at];
  }
  if (!from.guidance.empty()) {
    s.guidance.resize(n_cell);
    s.guidance[to] = from.guidance[at];
  }
  size_signals(from, n_cell, s);
  copy_signals(from, at, s, to);
  if (value_of(from.asleep, at, std::uint8_t{0}) == 0) return;
  s.asleep.resize(n_cell, 0);
  s.asleep[to] = 1;
}

/// Copies the last moves of all points of the cells that have them.
/// @param lane  [dcm] lane of each deformable cell in the composed state
void copy_last_moves(std::span<const SelectedCell<State>> dcm,
                     std::span<const SelectedCell<State>> cbm, std::span<const std::size_t> lane,
                     State& s) {
  const bool shared = worth_threads(s.dcm.n_row() + s.cbm.n_row());
  for_each_index(dcm.size(), shared, [&](std::size_t k) {
    const State& from = *dcm[k].state;
    if (!has_last_move(from)) return;
    const int n_point = from.dcm.group[dcm[k].index / kLanes].n_point();
    for (int i = 0; i < n_point; ++i)
      copy_move(from, dcm::node_address(from.dcm, dcm[k].index, i), s,
                dcm::node_address(s.dcm, lane[k], i));
  });
  for_each_index(cbm.size(), shared, [&](std::size_t k) {
    const State& from = *cbm[k].state;
    if (!has_last_move(from)) return;
    copy_move(from, cbm::cell_address(from.dcm.n_row(), cbm[k].index), s,
              cbm::cell_address(s.dcm.n_row(), k));
  });
}

/// Copies what a state has of the whole tissue: clock, balance, intervals and counters.
void copy_clocks(const State& from, State& s) {
  s.clock = from.clock;
  s.balance = from.balance;
  s.leader_interval = from.leader_interval;
  s.life_interval = from.life_interval;
  s.sleep_interval = from.sleep_interval;
  s.signal.interval = from.signal.interval;
  s.fading = from.fading;
  s.next_lineage = from.next_lineage;
  s.divisions = from.divisions;
  s.deaths = from.deaths;
}

}  // namespace

State compose(std::span<const SelectedCell<State>> dcm, std::span<const SelectedCell<State>> cbm,
              const State& like, std::vector<std::size_t>* stands, const Ranks* self) {
  State s;
  std::vector<SelectedCell<dcm::State>> shells;
  std::vector<SelectedCell<cbm::State>> spheres;
  for (const auto& [state, lane, type] : dcm) shells.push_back({&state->dcm, lane, type});
  for (const auto& [state, cell, type] : cbm) spheres.push_back({&state->cbm, cell, type});
  std::vector<std::size_t> lane;
  const std::vector<std::uint8_t> no_shell = mark_absent(dcm, false, self),
                                  no_sphere = mark_absent(cbm, true, self);
  s.dcm = dcm::compose(shells, lane, no_shell);
  s.cbm = cbm::compose(spheres, no_sphere);

  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  s.leader.assign(n_cell, 0);
  s.cycle = make_zeros<Cycle>(n_cell);
  std::fill_n(s.cycle.begin(), s.dcm.n_lane(), Cycle{});
  std::vector<int> holder;
  for (std::size_t k = 0; k < dcm.size(); ++k)
    copy_values(*dcm[k].state, dcm[k].index, true, like, s, lane[k], holder);
  for (std::size_t k = 0; k < cbm.size(); ++k)
    copy_values(*cbm[k].state, cell_index(*cbm[k].state, cbm[k].index),
                no_sphere.empty() || no_sphere[k] == 0, like, s, cell_index(s, k), holder);
  s.cell_holder = PagedValues(holder);
  if (std::ranges::any_of(cbm, [](const auto& c) { return !c.state->holder.empty(); }))
    s.holder = {cbm.size(), [&](std::size_t k) {
                  const State& from = *cbm[k].state;
                  return from.holder.empty() ? kEverywhere : from.holder[cbm[k].index];
                }};
  s.last_move = make_zeros<double>(s.dcm.position.size() + s.cbm.position.size());
  copy_last_moves(dcm, cbm, lane, s);
  copy_clocks(like, s);
  if (stands != nullptr) *stands = std::move(lane);
  return s;
}

std::vector<SelectedCell<State>> list_dcm(const State& s) {
  std::vector<SelectedCell<State>> list;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l)) list.push_back({&s, l});
  return list;
}

std::vector<SelectedCell<State>> list_cbm(const State& s) {
  std::vector<SelectedCell<State>> list;
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) list.push_back({&s, c});
  return list;
}

void exchange_cells(const Ranks& ranks, std::span<const std::uint8_t> gone,
                    std::span<const int> type, std::span<const State> fresh, State& s) {
  std::vector<SelectedCell<State>> shells, spheres;
  for_each_cell(s, [&](const Cell& c) {
    if (gone[c.index] == 0)
      (c.deformable ? shells : spheres).push_back({&s, c.at, type.empty() ? -1 : type[c.index]});
  });
  for (const State& f : fresh) {
    for (const SelectedCell<State>& m : list_dcm(f)) shells.push_back(m);
    for (const SelectedCell<State>& m : list_cbm(f)) spheres.push_back(m);
  }
  {
    const std::vector<Vec3> center =
        gather_places(ranks, s, [&s](std::size_t lane) { return center_of_lane(s, lane); });
    sort_along_curve(shells, false, s, center);
    sort_along_curve(spheres, true, s, center);
  }
  State next = compose(shells, spheres, s, nullptr, &ranks);
  if (s.near_set != 0 && !next.cell_holder.empty()) next.near_set = kOwnPoints;
  inherit_signals(fresh, s, next);
  if (has_last_move(s)) {
    const auto of_tree =
        s.last_move.end() - static_cast<std::ptrdiff_t>(s.tree.n_row()) * kPointStride;
    next.last_move.insert(next.last_move.end(), of_tree, s.last_move.end());
  } else {
    next.last_move.resize(next.last_move.size() + s.tree.n_row() * kPointStride, 0.0);
  }
  next.tree = std::move(s.tree);
  next.substance = std::move(s.substance);
  s = std::move(next);
}

}  // namespace acinus::coupling
