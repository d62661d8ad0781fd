#include "coupling/sleep/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers/time_grid.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// True if no active process moves the cell.
bool may_sleep(const State& s, const Cell& c) {
  const double t = s.clock.time;
  const Ramp& volume = volume_of(s, c);
  if (t < volume.end && volume.from != volume.to) return false;
  if (c.index < s.leader.size() && s.leader[c.index] != 0) return false;
  if (c.index < s.guidance.size() && !s.guidance[c.index].force.isZero(0)) return false;
  return c.deformable ? s.dcm.birth[c.at].is_forgotten(t) : t >= s.cbm.strength[c.at].end;
}

/// Loads of all cells without random motility, which sleepers do not have.
void observe_rest(World& world, Workspace& work) {
  bool& random = world.params.motility.random;
  const bool trembles = std::exchange(random, false);
  observe(world, work);
  random = trembles;
}

}  // namespace

std::vector<double> unbalanced_traction(const World& world, const Workspace& w) {
  const State& s = world.state;
  std::vector<double> traction(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
  const auto force_at = [&](Address a) -> Vec3 {
    return load_point(w.system.force.data(), a) + load_point(w.system.external_force.data(), a);
  };
  for_each_cell(s, [&](const Cell& c) {
    if (!w.system.ownership.owns(c.index / kLanes)) return;
    if (!c.deformable) {
      const double r = w.cbm_radius[c.at];
      traction[c.index] =
          force_at(cbm::cell_address(s.dcm.n_row(), c.at)).norm() / (4 * kPi * r * r);
      return;
    }
    const dcm::Group& g = s.dcm.group[c.at / kLanes];
    double sum = 0;
    const auto add = [&](const geometry::Topology& t, int first, double r2) {
      for (int i = 0; i < t.n_node; ++i)
        sum += force_at(dcm::node_address(s.dcm, c.at, first + i)).squaredNorm() /
               (t.rest_node_area[i] * r2);
    };
    const double r2 = w.lanes.radius[c.at] * w.lanes.radius[c.at];
    add(*g.topology, 0, r2);
    if (g.nucleus.exists())
      add(*g.nucleus.topology, g.topology->n_node, g.nucleus.size * g.nucleus.size * r2);
    traction[c.index] = std::sqrt(sum / (g.topology->rest_area * r2));
  });
  // Cells of other processes are 0.
  w.system.ownership.ranks.max(traction);
  return traction;
}

double time_to_sleep_event(const World& world) {
  const Sleep& p = world.params.sleep;
  if (!p.enabled || world.state.clock.phase != Phase::kRun)
    return std::numeric_limits<double>::infinity();
  return time_to_next_interval(time_of(world.state), p.grid);
}

void wake_all(World& world) {
  State& s = world.state;
  if (!world.params.sleep.enabled) return;
  s.asleep.clear();
  s.sleep_interval = grid_interval(time_of(s), world.params.sleep.grid);
}

bool update_sleep(World& world, Workspace& work) {
  State& s = world.state;
  const Sleep& p = world.params.sleep;
  if (!p.enabled || s.clock.phase != Phase::kRun) return true;
  const std::int64_t now = grid_interval(time_of(s), p.grid);
  if (now == s.sleep_interval) return true;
  const auto scope = work.timings.scope("sleep");
  observe_rest(world, work);
  const std::vector<double> traction = unbalanced_traction(world, work);
  std::vector<std::uint8_t> asleep(traction.size(), 0);
  for_each_cell(s, [&](const Cell& c) {
    asleep[c.index] = may_sleep(s, c) && traction[c.index] <= p.traction ? 1 : 0;
  });
  const std::int64_t before = std::exchange(s.sleep_interval, now);
  std::swap(s.asleep, asleep);
  if (count_asleep(s) > 0) {
    const LoopResult found = set_sleepers_velocity(world, work, time_to_sleep_event(world));
    if (found.last.interrupted) {
      std::swap(s.asleep, asleep);
      s.sleep_interval = before;
      return false;
    }
    if (!found.ok) std::ranges::fill(s.asleep, std::uint8_t{0});
  }
  if (count_asleep(s) == 0) s.asleep.clear();
  return true;
}

}  // namespace acinus::coupling
