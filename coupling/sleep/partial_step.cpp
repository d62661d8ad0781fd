#include "coupling/sleep/partial_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "coupling/migration/leaders.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/subworld/late_steps.hpp"
#include "coupling/subworld/ring.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Largest extrapolated displacement of a cell with its present velocity, um.
constexpr double kLongestExtrapolation = 0.25;

CellSet find_cells(const State& s, bool asleep) {
  CellSet cells;
  for_each_cell(s, [&](const Cell& c) {
    if ((s.asleep[c.index] != 0) == asleep) (c.deformable ? cells.dcm : cells.cbm).push_back(c.at);
  });
  return cells;
}

/// Chooses leaders among all cells, since a sleeper may be in front of an awake cell.
void choose_leaders_of_all(World& world) {
  State& s = world.state;
  if (!(world.params.motility.leader_force > 0) || s.clock.phase != Phase::kRun) return;
  choose_leaders(world.params, s, dcm::reference_radii(s.dcm, s.clock.time),
                 cbm::radii_at(s.cbm, s.clock.time), s.leader, s.leader_interval);
}

/// True if sleepers keep their velocity; only linearly implicit steps support it.
bool sleepers_move(const World& world) {
  return world.params.numerics.integrator == Integrator::kLinearlyImplicit;
}

/// Copies the present cells into a subworld of the same constants.
void take_part(const World& world, CellSet moving, CellSet constrained, Subworld& part) {
  take_cells(world.state, std::move(moving), std::move(constrained), part);
  part.work.constraint.prescribed_velocity = sleepers_move(world);
}

std::unique_ptr<Subworld> make_part(const World& world) {
  auto part = std::make_unique<Subworld>();
  take_params(world, *part);
  return part;
}

void start_last_moves(State& s) {
  if (!has_last_move(s)) s.last_move.assign(count_unknowns(s), 0.0);
}

/// Adds the counters of a subworld step to those of the whole world.
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

/// Moves sleepers with their velocity; without one they stay.
void move_sleepers(State& s, double step) {
  if (!has_last_move(s)) return;
  const double ratio = step / s.clock.last_step;
  for_each_cell(s, [&](const Cell& c) {
    if (s.asleep[c.index] == 0) return;
    for_each_point(s, c, [&](Address a) {
      const Vec3 move = ratio * load_point(s.last_move.data(), a);
      store_point(s.last_move.data(), a, move);
      double* at = position_of(s, a);
      store_point(at, 0, load_point(at, 0) + move);
    });
  });
}

/// Advances the clock alone; no cell is awake.
StepResult pass_time(World& world, double limit) {
  Clock& clock = world.state.clock;
  StepResult result;
  result.accepted = true;
  result.step = std::min(world.params.numerics.max_step, limit);
  if (sleepers_move(world)) move_sleepers(world.state, result.step);
  start_last_moves(world.state);
  clock.time += result.step;
  clock.last_step = result.step;
  ++clock.accepted;
  return result;
}

/// Limits velocities to the largest extrapolated displacement over a duration.
void limit_velocity(State& s, double duration) {
  for_each_cell(s, [&](const Cell& c) {
    double farthest2 = 0;
    for_each_point(s, c, [&](Address a) {
      farthest2 = std::max(farthest2, load_point(s.last_move.data(), a).squaredNorm());
    });
    const double way = duration / s.clock.last_step * std::sqrt(farthest2);
    if (!(way > kLongestExtrapolation)) return;
    for_each_point(s, c, [&](Address a) {
      store_point(s.last_move.data(), a,
                  kLongestExtrapolation / way * load_point(s.last_move.data(), a));
    });
  });
}

StepResult step_awake(World& world, Workspace& w, AwakePart& kept, CellSet awake, double limit) {
  choose_leaders_of_all(world);
  complete_contacts(world.ranks, world.state);
  if (!kept.subworld || kept.sized != w.sized) kept = {make_part(world), w.sized};
  Subworld& part = *kept.subworld;
  {
    const auto scope = w.timings.scope("awake part");
    CellSet ring = find_ring(world, awake);
    take_part(world, std::move(awake), std::move(ring), part);
  }
  std::swap(part.work.timings, w.timings);
  StepResult result = take_step(part.world, part.work, limit);
  complete_contacts(part.world.ranks, part.world.state);
  std::swap(part.work.timings, w.timings);
  move_counts(part.work, w);
  if (!result.accepted) return result;
  const auto scope = w.timings.scope("awake part");
  State& s = world.state;
  if (sleepers_move(world)) move_sleepers(s, result.step);
  start_last_moves(s);
  write_last_moves(part, 1, s);
  write_positions(part, s);
  s.clock = part.world.state.clock;
  s.balance = part.world.state.balance;
  return result;
}

}  // namespace

StepResult advance(World& world, Workspace& w, AwakePart& part, double limit) {
  if (count_asleep(world.state) == 0) {
    const LateSteps late = late_steps(world, w);
    return take_step(world, w, limit, &late);
  }
  complete_cells(world.ranks, world.state);
  CellSet awake = find_cells(world.state, false);
  if (awake.empty()) return pass_time(world, limit);
  return step_awake(world, w, part, std::move(awake), limit);
}

LoopResult set_sleepers_velocity(World& world, Workspace& w, double duration) {
  State& s = world.state;
  if (!sleepers_move(world) || !(s.clock.last_step > 0)) return {};
  const auto scope = w.timings.scope("sleepers");
  complete_contacts(world.ranks, s);
  complete_cells(world.ranks, s);
  CellSet sleepers = find_cells(s, true);
  CellSet ring = find_ring(world, sleepers);
  const std::unique_ptr<Subworld> made = make_part(world);
  Subworld& part = *made;
  take_part(world, std::move(sleepers), std::move(ring), part);
  State& small = part.world.state;
  limit_velocity(small, duration);
  small.guidance.clear();
  Params& params = part.world.params;
  params.motility.random = false;
  params.motility.leader_force = 0;
  params.numerics.extrapolate = false;
  params.numerics.max_step = duration;
  Clock& clock = small.clock;
  const double ratio = clock.last_step / duration;
  clock.step = duration;
  const std::vector<double> start = gather_positions(small);
  const LoopResult done =
      run_loop({.time_left = time_left_until(clock, clock.time + duration),
                .advance = [&](double limit) { return take_step(part.world, part.work, limit); }});
  complete_contacts(part.world.ranks, small);
  if (!done.ok) return done;
  move_counts(part.work, w);
  gather_positions(small, small.last_move);
  for (std::size_t k = 0; k < start.size(); ++k)
    small.last_move[k] = ratio * (small.last_move[k] - start[k]);
  start_last_moves(s);
  write_last_moves(part, 1, s);
  return done;
}

}  // namespace acinus::coupling
