#include "coupling/subworld/subworld.hpp"

#include <algorithm>
#include <utility>

#include "core/sort_unique.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/population.hpp"
#include "coupling/world/cell.hpp"
#include "geometry/box_pairs.hpp"

namespace acinus::coupling {
namespace {

/// First step of a subworld at rest, s: short, so that new contacts act before large motion.
constexpr double kFirstSubworldStep = 1;

Box box_of(const State& s, std::size_t lane) {
  Box box;
  const int n_node = s.dcm.group[lane / kLanes].topology->n_node;
  for (int i = 0; i < n_node; ++i)
    box.include(load_point(s.dcm.position.data(), dcm::node_address(s.dcm, lane, i)));
  return box;
}

Ramp frozen(const Ramp& r, double time) { return Ramp::constant(r.at(time)); }

/// True if the workspace of one state fits the other.
bool have_same_cells(const State& a, const State& b) {
  return a.dcm.lineage == b.dcm.lineage && a.cbm.lineage == b.cbm.lineage &&
         std::ranges::equal(a.dcm.group, b.dcm.group, [](const dcm::Group& g, const dcm::Group& h) {
           return g.topology == h.topology && g.type == h.type && g.nucleus == h.nucleus;
         });
}

/// Numbers that some process has, ascending.
void unite(const Ranks& ranks, std::vector<std::size_t>& numbers) {
  std::vector<std::size_t> all;
  ranks.gather<std::size_t>(numbers, all);
  sort_unique(all);
  numbers = std::move(all);
}

/// Calls f(address in the subworld, address in the whole world) for every moving point.
template <class F>
void for_each_moving_point(const Subworld& sub, const State& to, F f) {
  const State& from = sub.world.state;
  for (std::size_t k = 0; k < sub.moving.dcm.size(); ++k) {
    const std::size_t lane = sub.moving.dcm[k];
    const int n = to.dcm.group[lane / kLanes].n_point();
    for (int i = 0; i < n; ++i)
      f(dcm::node_address(from.dcm, sub.lane[k], i), dcm::node_address(to.dcm, lane, i));
  }
  for (std::size_t k = 0; k < sub.moving.cbm.size(); ++k)
    f(cbm::cell_address(from.dcm.n_row(), k), cbm::cell_address(to.dcm.n_row(), sub.moving.cbm[k]));
}

/// Replaces the contacts of moved spheres in the whole world.
void write_touching(const Subworld& sub, cbm::State& to) {
  std::vector<std::uint8_t> moves(to.n_cell(), 0);
  for (std::size_t c : sub.moving.cbm) moves[c] = 1;
  const auto is_replaced = [&](const std::pair<int, int>& pair) {
    return moves[pair.first] != 0 || (pair.second >= 0 && moves[pair.second] != 0);
  };
  const auto index = [&](int sphere) {
    const std::size_t k = sphere, n = sub.moving.cbm.size();
    return static_cast<int>(k < n ? sub.moving.cbm[k] : sub.constrained.cbm[k - n]);
  };
  std::erase_if(to.touching, is_replaced);
  for (const auto& [a, b] : sub.world.state.cbm.touching) {
    const int i = index(a), j = b < 0 ? b : index(b);
    const std::pair<int, int> pair{b < 0 ? i : std::min(i, j), b < 0 ? b : std::max(i, j)};
    if (is_replaced(pair)) to.touching.push_back(pair);
  }
  std::ranges::sort(to.touching);
}

}  // namespace

std::vector<std::size_t> lanes_of(const State& s, const CellSet& cells) {
  std::vector<std::size_t> lanes = cells.dcm;
  for (const std::size_t c : cells.cbm) lanes.push_back(cell_index(s, c));
  return lanes;
}

CellSet find_neighbours(const World& world, const CellSet& cells, double reach) {
  const State& s = world.state;
  const std::vector<double> radius = cbm::radii_at(s.cbm, s.clock.time);
  const auto sphere = [&](std::size_t c) {
    return sphere_box(cbm::center_of(s.cbm, c), radius[c]);
  };
  std::vector<Box> inner, outer;
  for (std::size_t l : cells.dcm) inner.push_back(box_of(s, l));
  for (std::size_t c : cells.cbm) inner.push_back(sphere(c));
  const auto is_tested = [&](std::size_t lane) { return holds_points(world.ranks, s, lane); };
  CellSet others;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l) && is_tested(l) && !std::ranges::binary_search(cells.dcm, l))
      others.dcm.push_back(l);
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    if (is_tested(s.dcm.n_lane() + c) && !std::ranges::binary_search(cells.cbm, c))
      others.cbm.push_back(c);
  for (std::size_t l : others.dcm) outer.push_back(box_of(s, l));
  for (std::size_t c : others.cbm) outer.push_back(sphere(c));
  std::vector<std::uint8_t> near(outer.size(), 0);
  for (const auto& pair : geometry::find_pairs_between(inner, outer, reach)) near[pair.second] = 1;
  const std::size_t n_shell = others.dcm.size();
  CellSet found;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (near[k] == 0) continue;
    if (k < n_shell)
      found.dcm.push_back(others.dcm[k]);
    else
      found.cbm.push_back(others.cbm[k - n_shell]);
  }
  if (s.near_set != 0) {
    unite(world.ranks, found.dcm);
    unite(world.ranks, found.cbm);
  }
  return found;
}

void take_params(const World& world, Subworld& sub) {
  sub.world.params = world.params;
  sub.world.ranks = world.ranks;
  sub.world.sharing = world.sharing;
}

void take_cells(const State& state, CellSet moving, CellSet constrained, Subworld& sub) {
  std::vector<SelectedCell<State>> shells, spheres;
  for (const CellSet* cells : {&moving, &constrained}) {
    for (std::size_t l : cells->dcm) shells.push_back({&state, l});
    for (std::size_t c : cells->cbm) spheres.push_back({&state, c});
  }
  std::vector<std::size_t> lane;
  State small = compose(shells, spheres, state, &lane);
  small.asleep.clear();
  std::vector<std::uint8_t> is_constrained(small.dcm.n_lane() + small.cbm.n_cell(), 0);
  for (std::size_t k = moving.dcm.size(); k < lane.size(); ++k) is_constrained[lane[k]] = 1;
  for (std::size_t k = moving.cbm.size(); k < spheres.size(); ++k)
    is_constrained[cell_index(small, k)] = 1;
  const auto first_constrained = lane.begin() + static_cast<std::ptrdiff_t>(moving.dcm.size());
  sub.constrained_lane.assign(first_constrained, lane.end());
  lane.resize(moving.dcm.size());
  const bool same =
      have_same_cells(small, sub.world.state) && is_constrained == sub.work.constraint.cell;
  sub.world.state = std::move(small);
  sub.moving = std::move(moving);
  sub.constrained = std::move(constrained);
  sub.lane = std::move(lane);
  if (same) return;
  sub.work.constraint.cell = std::move(is_constrained);
  size_workspace(sub.world, sub.work);
}

void extract_at_rest(const World& world, CellSet moving, CellSet constrained, Subworld& sub) {
  take_params(world, sub);
  Params& params = sub.world.params;
  contact::for_each_wall(params.boundary, [&](auto, auto, auto& wall) {
    contact::stop_wall(wall, time_since_start(world));
  });
  params.motility.random = false;
  params.motility.leader_force = 0;
  params.apparatus.remove_drives();
  params.numerics.adaptive = true;
  take_cells(world.state, std::move(moving), std::move(constrained), sub);
  State& s = sub.world.state;
  s.fading.clear();
  s.guidance.clear();
  const double now = s.clock.time;
  for (Ramp& v : s.dcm.volume) v = frozen(v, now);
  for (dcm::BirthShape& b : s.dcm.birth) b.weight = frozen(b.weight, now);
  for (Ramp& v : s.cbm.volume) v = frozen(v, now);
  s.cbm.strength.replace([&](const Ramp& v) { return frozen(v, now); });
  s.balance = {};
  s.clock.step = kFirstSubworldStep;
  s.clock.last_step = 0;
  s.clock.accepted = s.clock.rejected = s.clock.shortened = 0;
  s.clock.cg_iterations = s.clock.solves = 0;
  s.clock.coarse = false;
}

Settling relax(Subworld& sub, double duration) {
  const Clock& clock = sub.world.state.clock;
  const LoopResult result =
      run_loop({.time_left = time_left_until(clock, clock.time + duration),
                .advance = [&](double limit) { return take_step(sub.world, sub.work, limit); }});
  complete_contacts(sub.world.ranks, sub.world.state);
  return {result.ok, result.ok ? "" : result.last.cause, result.steps};
}

void write_positions(const Subworld& sub, State& to) {
  const State& from = sub.world.state;
  for_each_moving_point(sub, to, [&](Address a, Address b) {
    store_point(position_of(to, b), 0, load_point(position_of(from, a), 0));
  });
  for (std::size_t k = 0; k < sub.moving.dcm.size(); ++k)
    to.dcm.tension[sub.moving.dcm[k]] = from.dcm.tension[sub.lane[k]];
  if (!sub.moving.cbm.empty()) write_touching(sub, to.cbm);
}

void write_last_moves(const Subworld& sub, double ratio, State& to) {
  for_each_moving_point(sub, to, [&](Address a, Address b) {
    store_point(to.last_move.data(), b, ratio * load_point(sub.world.state.last_move.data(), a));
  });
}

void write_moved(const Subworld& sub, State& to) {
  write_positions(sub, to);
  const State& from = sub.world.state;
  if (has_last_move(from) && has_last_move(to))
    write_last_moves(sub, to.clock.last_step / from.clock.last_step, to);
}

}  // namespace acinus::coupling
