#include "coupling/awake.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "coupling/leaders.hpp"
#include "coupling/life/cell.hpp"
#include "coupling/population.hpp"

namespace acinus::coupling {
namespace {

constexpr double kSameTime = 1e-6;  // s
/// How far cells may be thought to go on at their present pace, um.
constexpr double kLongestWay = 0.25;

Selected find_cells(const State& s, bool asleep) {
  Selected cells;
  for_each_cell(s, [&](const Cell& c) {
    if ((s.asleep[c.index] != 0) == asleep) (c.deformable ? cells.dcm : cells.cbm).push_back(c.at);
  });
  return cells;
}

/// Gap, um, beyond which no two cells act on each other, with room for the growth of a step.
double find_reach(const World& world) {
  const State& s = world.state;
  const Params& p = world.params;
  const std::vector<double> shell = dcm::reference_radii(s.dcm, s.clock.time),
                            sphere = cbm::radii_at(s.cbm, s.clock.time);
  double reach = cbm::largest_separation(s.cbm, p.cbm, sphere, p.around) + p.cbm_contact.skin;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l))
      reach = std::max(reach, p.dcm_contact.skin +
                                  dcm::contact_range(p.dcm_contact,
                                                     *s.dcm.group[l / kLanes].topology, shell[l]));
  return reach;
}

/// Members of both, each ascending.
Selected unite(const Selected& a, const Selected& b) {
  Selected all;
  std::ranges::set_union(a.dcm, b.dcm, std::back_inserter(all.dcm));
  std::ranges::set_union(a.cbm, b.cbm, std::back_inserter(all.cbm));
  return all;
}

Selected subtract(const Selected& a, const Selected& b) {
  Selected rest;
  std::ranges::set_difference(a.dcm, b.dcm, std::back_inserter(rest.dcm));
  std::ranges::set_difference(a.cbm, b.cbm, std::back_inserter(rest.cbm));
  return rest;
}

/// Leaders are chosen among all cells: a sleeper may stand before one awake.
void choose_leaders_of_all(World& world) {
  State& s = world.state;
  if (!(world.params.motility.leader_force > 0) || s.clock.phase != Phase::kRun) return;
  choose_leaders(world, dcm::reference_radii(s.dcm, s.clock.time),
                 cbm::radii_at(s.cbm, s.clock.time), s.leader, s.leader_interval);
}

/// Whether a workspace made for one of two states serves the other.
bool have_same_cells(const State& a, const State& b) {
  return a.dcm.lineage == b.dcm.lineage && a.cbm.lineage == b.cbm.lineage && a.asleep == b.asleep &&
         std::ranges::equal(a.dcm.group, b.dcm.group, [](const dcm::Group& g, const dcm::Group& h) {
           return g.topology == h.topology && g.type == h.type;
         });
}

/// Whether what sleeps goes on at its pace: only linearly implicit steps know of it.
bool glides(const World& world) {
  return world.params.numerics.integrator == Integrator::kLinearlyImplicit;
}

/// The part as it is now, in which the first cells move and the others are held.
AwakePart& make_part(const World& world, Selected moving, Selected held,
                     std::shared_ptr<AwakePart>& made, const Workspace& w) {
  const State& s = world.state;
  std::vector<Member> shells, spheres;
  for (const Selected* cells : {&moving, &held}) {
    for (std::size_t l : cells->dcm) shells.push_back({&s, l});
    for (std::size_t c : cells->cbm) spheres.push_back({&s, c});
  }
  std::vector<std::size_t> lane;
  State small = compose(shells, spheres, s, &lane);
  small.asleep.assign(small.dcm.n_lane() + small.cbm.n_cell(), 0);
  for (std::size_t k = moving.dcm.size(); k < lane.size(); ++k) small.asleep[lane[k]] = 1;
  for (std::size_t k = moving.cbm.size(); k < spheres.size(); ++k)
    small.asleep[cell_index(small, k)] = 1;
  lane.resize(moving.dcm.size());
  if (!made) {
    made = std::make_shared<AwakePart>();
    made->world.params = world.params;
    made->work.holds = true;
  }
  AwakePart& part = *made;
  const bool same = have_same_cells(small, part.world.state);
  part.world.state = std::move(small);
  part.moving = std::move(moving);
  part.held = std::move(held);
  part.lane = std::move(lane);
  if (!same) size_workspace(part.world, part.work);
  part.work.glides = glides(world);
  part.work.reject_every = w.reject_every;
  part.work.partitioned = w.partitioned;
  return part;
}

/// Contacts of spheres that moved replace those they had.
void write_touching(const AwakePart& part, cbm::State& to) {
  std::vector<std::uint8_t> moves(to.n_cell(), 0);
  for (std::size_t c : part.moving.cbm) moves[c] = 1;
  const auto is_replaced = [&](const std::pair<int, int>& pair) {
    return moves[static_cast<std::size_t>(pair.first)] != 0 ||
           (pair.second >= 0 && moves[static_cast<std::size_t>(pair.second)] != 0);
  };
  const auto index = [&](int sphere) {
    const auto k = static_cast<std::size_t>(sphere), n = part.moving.cbm.size();
    return static_cast<int>(k < n ? part.moving.cbm[k] : part.held.cbm[k - n]);
  };
  std::erase_if(to.touching, is_replaced);
  for (const auto& [a, b] : part.world.state.cbm.touching) {
    const int i = index(a), j = b < 0 ? b : index(b);
    const std::pair<int, int> pair{b < 0 ? i : std::min(i, j), b < 0 ? b : std::max(i, j)};
    if (is_replaced(pair)) to.touching.push_back(pair);
  }
  std::ranges::sort(to.touching);
}

/// Where a point of a cell is kept.
double* position_of(State& s, Address a) {
  const std::size_t n = s.dcm.position.size();
  const auto k = static_cast<std::size_t>(a);
  return k < n ? s.dcm.position.data() + k : s.cbm.position.data() + (k - n);
}

/// Calls f with where each point that moves stands in the part and in the whole.
template <class F>
void for_each_moving_point(const AwakePart& part, const State& to, F f) {
  const State& from = part.world.state;
  for (std::size_t k = 0; k < part.moving.dcm.size(); ++k) {
    const std::size_t lane = part.moving.dcm[k];
    const int n = to.dcm.group[lane / kLanes].topology->n_node;
    for (int i = 0; i < n; ++i)
      f(dcm::node_address(from.dcm, part.lane[k], i), dcm::node_address(to.dcm, lane, i));
  }
  for (std::size_t k = 0; k < part.moving.cbm.size(); ++k)
    f(cbm::cell_address(from.dcm.n_row(), k),
      cbm::cell_address(to.dcm.n_row(), part.moving.cbm[k]));
}

/// What moves in the part does so in the whole.
void write_pace(const AwakePart& part, State& to) {
  if (!has_last_move(to)) to.last_move.assign(to.dcm.position.size() + to.cbm.position.size(), 0.0);
  for_each_moving_point(part, to, [&](Address a, Address b) {
    store_point(to.last_move.data(), b, load_point(part.world.state.last_move.data(), a));
  });
}
void write_moves(AwakePart& part, State& to) {
  write_pace(part, to);
  for_each_moving_point(part, to, [&](Address a, Address b) {
    store_point(position_of(to, b), 0, load_point(position_of(part.world.state, a), 0));
  });
  if (to.cbm.n_cell() > 0) write_touching(part, to.cbm);
}

/// What a run tells about work done and left out counts wherever it happened.
void move_counts(Workspace& from, Workspace& to) {
  to.dcm.lists.checked += std::exchange(from.dcm.lists.checked, 0);
  to.dcm.lists.made += std::exchange(from.dcm.lists.made, 0);
  to.dcm.searches += std::exchange(from.dcm.searches, 0);
  to.dcm.points_listed += std::exchange(from.dcm.points_listed, 0);
  to.dcm.points_seen += std::exchange(from.dcm.points_seen, 0);
  to.cbm.list_builds += std::exchange(from.cbm.list_builds, 0);
  to.cbm.searches += std::exchange(from.cbm.searches, 0);
  to.cbm.corrected += std::exchange(from.cbm.corrected, 0);
  to.cbm.beyond += std::exchange(from.cbm.beyond, 0);
}

/// Sleepers go on at their pace.
void glide(State& s, double step) {
  if (!has_last_move(s)) return;
  const double pace = step / s.clock.last_step;
  for_each_cell(s, [&](const Cell& c) {
    if (s.asleep[c.index] == 0) return;
    for_each_point(s, c, [&](Address a) {
      const Vec3 move = pace * load_point(s.last_move.data(), a);
      store_point(s.last_move.data(), a, move);
      double* at = position_of(s, a);
      store_point(at, 0, load_point(at, 0) + move);
    });
  });
}

/// Time passes: sleepers glide, and nobody is awake.
StepResult pass_time(World& world, double limit) {
  Clock& clock = world.state.clock;
  StepResult result;
  result.accepted = true;
  result.step = std::min(world.params.numerics.max_step, limit);
  if (glides(world)) glide(world.state, result.step);
  clock.time += result.step;
  clock.last_step = result.step;
  ++clock.accepted;
  return result;
}

/// Slows cells down that would go too far in so long a time.
void limit_pace(State& s, double duration) {
  for_each_cell(s, [&](const Cell& c) {
    double farthest2 = 0;
    for_each_point(s, c, [&](Address a) {
      farthest2 = std::max(farthest2, load_point(s.last_move.data(), a).squaredNorm());
    });
    const double way = duration / s.clock.last_step * std::sqrt(farthest2);
    if (!(way > kLongestWay)) return;
    for_each_point(s, c, [&](Address a) {
      store_point(s.last_move.data(), a, kLongestWay / way * load_point(s.last_move.data(), a));
    });
  });
}

}  // namespace

Selected find_ring(const World& world, const Selected& cells) {
  const double reach = find_reach(world);
  const Selected near = find_neighbours(world, cells, reach);
  if (near.cbm.empty()) return near;
  const Selected next = find_neighbours(world, {{}, near.cbm}, reach);
  return subtract(unite(near, next), cells);
}

StepResult advance_awake(World& world, Workspace& w, double limit) {
  Selected awake = find_cells(world.state, false);
  if (awake.dcm.empty() && awake.cbm.empty()) return pass_time(world, limit);
  choose_leaders_of_all(world);
  AwakePart& part = [&]() -> AwakePart& {
    const auto scope = w.timings.scope("awake part");
    Selected ring = find_ring(world, awake);
    return make_part(world, std::move(awake), std::move(ring), w.awake, w);
  }();
  std::swap(part.work.timings, w.timings);
  StepResult result = advance(part.world, part.work, limit);
  std::swap(part.work.timings, w.timings);
  move_counts(part.work, w);
  if (!result.accepted) return result;
  const auto scope = w.timings.scope("awake part");
  if (glides(world)) glide(world.state, result.step);
  write_moves(part, world.state);
  world.state.clock = part.world.state.clock;
  world.state.balance = part.world.state.balance;
  return result;
}

bool set_sleepers_pace(World& world, Workspace& w, double duration) {
  State& s = world.state;
  if (!glides(world) || !(s.clock.last_step > 0)) return true;
  const auto scope = w.timings.scope("sleepers");
  Selected sleepers = find_cells(s, true);
  Selected ring = find_ring(world, sleepers);
  AwakePart& part = make_part(world, std::move(sleepers), std::move(ring), w.sleepers, w);
  State& small = part.world.state;
  limit_pace(small, duration);
  Params& params = part.world.params;
  params.motility.random = false;
  params.motility.leader_force = 0;
  params.numerics.extrapolate = false;
  params.numerics.max_step = duration;
  Clock& clock = small.clock;
  const double pace = clock.last_step / duration, end = clock.time + duration;
  clock.step = duration;
  const std::vector<double> start = gather_positions(small);
  while (clock.time < end - kSameTime)
    if (!advance(part.world, part.work, end - clock.time).accepted) return false;
  move_counts(part.work, w);
  small.last_move = gather_positions(small);
  for (std::size_t k = 0; k < start.size(); ++k)
    small.last_move[k] = pace * (small.last_move[k] - start[k]);
  write_pace(part, s);
  return true;
}

}  // namespace acinus::coupling
