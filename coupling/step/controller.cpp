#include "coupling/step/controller.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel/make_room.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/step/balance.hpp"
#include "coupling/step/balance_shares.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/move_points.hpp"
#include "coupling/step/near_cells.hpp"
#include "coupling/step/shorten.hpp"
#include "coupling/step/step.hpp"
#include "dcm/tensions.hpp"

namespace acinus::coupling {
namespace {

/// Iterations per solve above which the coarse space is enabled, and below which it is disabled
/// again.
constexpr int kCoarseOn = 60, kCoarseOff = 15;

/// True if a coarse space pays in the next step. It does for connected cells with many nodes; for
/// spheres alone the block-diagonal preconditioner is as good.
bool want_coarse(const State& s, int iterations_per_solve) {
  if (s.dcm.group.empty()) return false;
  return iterations_per_solve > (s.clock.coarse ? kCoarseOff : kCoarseOn);
}

/// Length of the next step from the error and the displacements of this one.
double next_step(const Numerics& n, double step, const Assessment& a) {
  if (!n.adaptive) return n.max_step;
  constexpr double kLeast = 0.5, kMost = 2;
  double factor = kMost;
  if (a.error > 0) factor = std::min(factor, kErrorShare * std::sqrt(n.tolerance / a.error));
  if (a.excess > 0) factor = std::min(factor, kMoveShare / a.excess);
  return std::clamp(step * std::max(factor, kLeast), n.min_step, n.max_step);
}

/// Length of a retry over that of the rejected step. What is shortened too much to be taken is
/// computed again with twice the length that would do if motion were steady, since motion that
/// decays within a step is faster in a shorter one.
/// @param usable  part of the rejected displacement that would do; 0: unknown
double retry_factor(double usable) {
  constexpr double kLeast = 1.0 / 16, kUsual = 0.5;
  return usable > 0 ? std::clamp(2 * usable, kLeast, kUsual) : kUsual;
}

void record_balance(const World& world, Workspace& w, Balance& largest) {
  const Balance b = measure_balance(world, w);
  largest.momentum = std::max(largest.momentum, b.momentum);
  largest.torque = std::max(largest.torque, b.torque);
  largest.friction_torque = std::max(largest.friction_torque, b.friction_torque);
}

/// Moves the points of all processes, or own and near ones, and keeps the displacements of all or
/// of own cells.
void move_all_points(World& world, const Workspace& w) {
  State& s = world.state;
  if (!s.cell_holder.empty()) {
    move_present_points(w, w.move, s);
    return keep_own_moves(w, s);
  }
  set_size(s.last_move, w.move.size());
  stream_rows(w.system, w.move, [&](std::size_t first, std::span<const double> move) {
    move_points(s, first, move);
    for_each_number(move.size(), [&](std::size_t k) { s.last_move[first + k] = move[k]; });
  });
}

void commit(double step, const Effort& effort, World& world, Workspace& w) {
  State& s = world.state;
  const bool moves = w.constraint.prescribed_velocity;
  place_constrained(
      moves ? std::span<const double>(w.linearisation.move) : std::span<const double>{}, w);
  dcm::begin_tensions(w.dcm_params, s.dcm);
  move_all_points(world, w);
  place_vessels(world.params.tree, s.tree, world.params.boundary.vessels);
  dcm::advance_tensions(w.dcm_params, step, s.dcm);
  std::swap(s.cbm.touching, w.cbm.touching);
  s.leader = w.leader;
  s.leader_interval = w.leader_interval;
  s.clock.time += step;
  dcm::drop_forgotten(s.clock.time, s.dcm.birth);
  s.clock.last_step = step;
  s.clock.accepted += 1;
  s.clock.cg_iterations += effort.cg_iterations;
  s.clock.solves += effort.solves;
  s.clock.longest_solve = effort.longest_solve;
  s.clock.coarse = want_coarse(s, effort.cg_iterations / std::max(effort.solves, 1));
}

/// Advances late cells by themselves if there are few and the step suits all others.
/// @param a  assessment of the displacement of all; on return, if true, of the others
bool let_late_cells_step(const World& world, double step, const LateSteps& late, Workspace& w,
                         Assessment& a) {
  const std::vector<std::size_t> cells = find_late_cells(world, step, a, w);
  if (cells.empty()) return false;
  mark_late(cells, w);
  const Assessment others = assess_step(world, step, 1, {}, w);
  w.late.clear();
  if (!others.accepted || !late.advance(step, cells)) return false;
  a = others;
  return true;
}

}  // namespace

StepResult take_step(World& world, Workspace& w, double limit, const LateSteps* late) {
  State& s = world.state;
  const Numerics& n = world.params.numerics;
  hand_over_contacts(world.ranks, w, s);
  hand_over_cells(world, w);
  refresh_near_cells(world, w);
  StepResult result;
  Effort effort;
  w.failed_solves = 0;
  double wanted = s.clock.step > 0 ? std::min(s.clock.step, n.max_step) : n.max_step;
  for (;;) {
    const double computed = std::min(wanted, limit);
    Assessment a = attempt_step(world, computed, result.rejections == 0, w, effort);
    Balance balance = s.balance;
    if (a.accepted || a.usable > 0) record_balance(world, w, balance);
    const bool has_late = late != nullptr && let_late_cells_step(world, computed, *late, w, a);
    const double part = shorten_step(world, computed, w, a), step = part * computed;
    if (a.accepted) {
      const auto scope = w.timings.scope("commit");
      s.balance = balance;
      commit(step, effort, world, w);
      if (has_late) late->write();
      s.clock.rejected += result.rejections;
      s.clock.shortened += part < 1 || has_late ? 1 : 0;
      // A step that ends at an event predicts little about the length of the next.
      s.clock.step = computed < wanted ? wanted : next_step(n, step, a);
      result.accepted = true;
      result.step = step;
      result.error = a.error;
      result.max_move = a.max_move;
      balance_shares(world, w);
      return result;
    }
    if (stop_requested()) {
      result.interrupted = true;
      return result;
    }
    ++result.rejections;
    result.cause = a.cause;
    result.cells = a.cells;
    if (computed <= n.min_step) return result;
    wanted = std::max(retry_factor(a.usable) * computed, n.min_step);
  }
}

}  // namespace acinus::coupling
