#include "coupling/subworld.hpp"

#include <algorithm>
#include <map>

#include "core/contact/box.hpp"
#include "coupling/population.hpp"

namespace acinus::coupling {
namespace {

/// First step in a small world, s: contacts just made are felt before anything has moved far.
constexpr double kFirstStep = 1;

constexpr double kSameTime = 1e-9;  // s

contact::Box box_of(const State& s, std::size_t lane) {
  contact::Box box;
  const int n_node = s.dcm.group[lane / kLanes].topology->n_node;
  for (int i = 0; i < n_node; ++i)
    box.include(load_point(s.dcm.position.data(), dcm::node_address(s.dcm, lane, i)));
  return box;
}

/// Walls stay where they are at this moment.
void stop_walls(contact::Surroundings& around, double time) {
  for (contact::Plane& p : around.planes) {
    p.point = p.point_at(time);  // far away if it is gone
    p.opens = contact::Plane{}.opens;
    p.speed = 0;
  }
  for (contact::Capsule& c : around.capsules) {
    c.radius = c.radius_at(time);
    c.speed = 0;  // and one that is open has an infinite radius
  }
}

Ramp frozen(const Ramp& r, double time) { return Ramp::constant(r.at(time)); }

/// Index of every lineage that moves.
std::map<std::int64_t, std::size_t> index_moving(const std::vector<std::int64_t>& lineage,
                                                 std::span<const std::uint8_t> held) {
  std::map<std::int64_t, std::size_t> index;
  for (std::size_t k = 0; k < lineage.size(); ++k)
    if (lineage[k] != dcm::kEmptyLane && (held.empty() || held[k] == 0)) index[lineage[k]] = k;
  return index;
}

/// The sphere contacts of `from` replace those that `to` has between the same cells.
void write_touching(const cbm::State& from, const std::map<std::int64_t, std::size_t>& moving,
                    cbm::State& to) {
  std::map<std::int64_t, std::size_t> all;
  for (std::size_t c = 0; c < to.n_cell(); ++c) all[to.lineage[c]] = c;
  std::vector<std::uint8_t> inside(to.n_cell(), 0), moves(to.n_cell(), 0);
  for (std::int64_t id : from.lineage) inside[all.at(id)] = 1;
  for (const auto& [id, c] : moving) moves[all.at(id)] = 1;
  const auto is_replaced = [&](const std::pair<int, int>& pair) {
    const auto a = static_cast<std::size_t>(pair.first);
    if (pair.second < 0) return moves[a] != 0;
    const auto b = static_cast<std::size_t>(pair.second);
    return inside[a] != 0 && inside[b] != 0 && (moves[a] != 0 || moves[b] != 0);
  };
  std::erase_if(to.touching, is_replaced);
  for (const auto& [a, b] : from.touching) {
    const auto index = [&](int cell) {
      return static_cast<int>(all.at(from.lineage[static_cast<std::size_t>(cell)]));
    };
    const int i = index(a), j = b < 0 ? b : index(b);
    const std::pair<int, int> pair{b < 0 ? i : std::min(i, j), b < 0 ? b : std::max(i, j)};
    if (is_replaced(pair)) to.touching.push_back(pair);
  }
  std::ranges::sort(to.touching);
}

}  // namespace

Selected find_neighbours(const World& world, const Selected& cells, double reach) {
  const State& s = world.state;
  const std::vector<double> radius = cbm::radii_at(s.cbm, s.clock.time);
  const auto sphere = [&](std::size_t c) {
    return contact::sphere_box(cbm::center_of(s.cbm, c), radius[c]);
  };
  std::vector<contact::Box> inner, outer;
  for (std::size_t l : cells.dcm) inner.push_back(box_of(s, l));
  for (std::size_t c : cells.cbm) inner.push_back(sphere(c));
  Selected others;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l) && !std::ranges::binary_search(cells.dcm, l)) others.dcm.push_back(l);
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    if (!std::ranges::binary_search(cells.cbm, c)) others.cbm.push_back(c);
  for (std::size_t l : others.dcm) outer.push_back(box_of(s, l));
  for (std::size_t c : others.cbm) outer.push_back(sphere(c));
  std::vector<std::uint8_t> near(outer.size(), 0);
  for (const auto& pair : contact::find_pairs_between(inner, outer, reach))
    near[static_cast<std::size_t>(pair.second)] = 1;
  const std::size_t n_shell = others.dcm.size();
  Selected found;
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (near[k] == 0) continue;
    if (k < n_shell)
      found.dcm.push_back(others.dcm[k]);
    else
      found.cbm.push_back(others.cbm[k - n_shell]);
  }
  return found;
}

Subworld extract(const World& world, const Selected& moving, const Selected& held) {
  const State& s = world.state;
  Subworld sub;
  sub.time = s.clock.time;
  sub.world.params = world.params;
  stop_walls(sub.world.params.around, time_since_start(world));
  sub.world.params.motility.random = false;
  sub.world.params.motility.leader_force = 0;
  sub.world.params.numerics.adaptive = true;
  std::vector<Member> shells, spheres;
  for (const Selected* part : {&moving, &held}) {
    for (std::size_t l : part->dcm) shells.push_back({&s, l});
    for (std::size_t c : part->cbm) spheres.push_back({&s, c});
  }
  State& small = sub.world.state;
  small = compose(shells, spheres, s);
  for (Ramp& v : small.dcm.volume) v = frozen(v, s.clock.time);
  for (dcm::BirthShape& b : small.dcm.birth) b.weight = frozen(b.weight, s.clock.time);
  for (Ramp& v : small.cbm.volume) v = frozen(v, s.clock.time);
  for (Ramp& v : small.cbm.strength) v = frozen(v, s.clock.time);
  small.asleep.assign(small.dcm.n_lane() + small.cbm.n_cell(), 0);
  std::vector<std::int64_t> still;
  for (std::size_t l : held.dcm) still.push_back(s.dcm.lineage[l]);
  for (std::size_t c : held.cbm) still.push_back(s.cbm.lineage[c]);
  std::ranges::sort(still);
  for (std::size_t l = 0; l < small.dcm.n_lane(); ++l)
    small.asleep[l] = std::ranges::binary_search(still, small.dcm.lineage[l]) ? 1 : 0;
  for (std::size_t c = 0; c < small.cbm.n_cell(); ++c)
    small.asleep[cell_index(small, c)] =
        std::ranges::binary_search(still, small.cbm.lineage[c]) ? 1 : 0;
  small.balance = {};
  small.clock.step = kFirstStep;
  small.clock.last_step = 0;
  small.clock.accepted = small.clock.rejected = small.clock.cg_iterations = small.clock.solves = 0;
  small.clock.coarse = false;
  sub.work.holds = true;
  size_workspace(sub.world, sub.work);
  return sub;
}

Settling relax(Subworld& sub, double duration) {
  Settling settling;
  Clock& clock = sub.world.state.clock;
  const double end = sub.time + duration;
  while (clock.time < end - kSameTime) {
    const StepResult result = advance(sub.world, sub.work, end - clock.time);
    if (!result.accepted) {
      settling.ok = false;
      settling.cause = result.cause;
      return settling;
    }
    ++settling.steps;
  }
  return settling;
}

void write_back(const Subworld& sub, World& world) {
  const State& from = sub.world.state;
  State& to = world.state;
  const std::span<const std::uint8_t> held(from.asleep);
  const auto shells =
      index_moving(from.dcm.lineage, held.empty() ? held : held.first(from.dcm.n_lane()));
  const auto spheres =
      index_moving(from.cbm.lineage, held.empty() ? held : held.subspan(from.dcm.n_lane()));
  const bool move = has_last_move(from) && has_last_move(to);
  const double ratio = move ? to.clock.last_step / from.clock.last_step : 0;
  for (std::size_t l = 0; l < to.dcm.n_lane(); ++l) {
    const auto it = to.dcm.active(l) ? shells.find(to.dcm.lineage[l]) : shells.end();
    if (it == shells.end()) continue;
    const int n_node = to.dcm.group[l / kLanes].topology->n_node;
    for (int i = 0; i < n_node; ++i) {
      const Address a = dcm::node_address(from.dcm, it->second, i),
                    b = dcm::node_address(to.dcm, l, i);
      store_point(to.dcm.position.data(), b, load_point(from.dcm.position.data(), a));
      if (move) store_point(to.last_move.data(), b, ratio * load_point(from.last_move.data(), a));
    }
  }
  for (std::size_t c = 0; c < to.cbm.n_cell(); ++c) {
    const auto it = spheres.find(to.cbm.lineage[c]);
    if (it == spheres.end()) continue;
    store_point(to.cbm.position.data(), cbm::cell_address(0, c),
                cbm::center_of(from.cbm, it->second));
    if (move)
      store_point(to.last_move.data(), cbm::cell_address(to.dcm.n_row(), c),
                  ratio * load_point(from.last_move.data(),
                                     cbm::cell_address(from.dcm.n_row(), it->second)));
  }
  if (!from.cbm.lineage.empty()) write_touching(from.cbm, spheres, to.cbm);
}

}  // namespace acinus::coupling
