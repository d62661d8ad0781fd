#include "coupling/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers/time_grid.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/measure/signals.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/sleep/sleep.hpp"
#include "coupling/start_up.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/near_cells.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/substances/responses.hpp"

namespace acinus::coupling {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Longest step after a discontinuity, s: the last step predicts nothing there.
constexpr double kFirstStep = 0.1;

/// Next time after `time` at which a device changes its action or a wall opens, s; infinite if
/// there is none.
double next_change(const Params& p, double time) {
  const double later = time + kSameTime;
  double next = p.apparatus.next_change(later);
  contact::for_each_wall(p.boundary, [&](auto, auto, const auto& wall) {
    if (wall.opens > later) next = std::min(next, wall.opens);
  });
  return next;
}

/// True if a device changed its action or a wall opened at a time after t = 0, s.
bool is_change(const Params& p, double time) {
  return time > kSameTime && next_change(p, time - 3 * kSameTime) < time + kSameTime;
}

/// Resets step-size control, so that the next step counts as the first.
void start_anew(Clock& clock) {
  clock.last_step = 0;
  clock.step = std::min(clock.step, kFirstStep);
}

}  // namespace

Simulation::Simulation(World world) : world_(std::move(world)) { resize(); }

void Simulation::resize() { size_workspace(world_, work_); }

void Simulation::complete_points() { coupling::complete_points(world_, work_); }

void Simulation::refresh_points() { refresh_near_cells(world_, work_); }

double Simulation::time_to_event(const Observer& observer) const {
  if (!is_running()) return time_to_phase_event(world_);
  const double t = time();
  double left = next_change(world_.params, t) - t;
  if (observer.next_moment) left = std::min(left, observer.next_moment(t) - t);
  left = std::min(left, next_supply_change(world_.params.substances, t + kSameTime) - t);
  left = std::min(left, coupling::time_to_event(world_));
  const Motility& m = world_.params.motility;
  if (m.leader_force > 0)
    left = std::min(left, (std::floor((t + kSameTime) / m.leader_grid) + 1) * m.leader_grid - t);
  return left;
}

void Simulation::end_step_of_start_up(const Observer& observer) {
  do {  // a phase may have no length
    const std::string what = update_phase(world_, work_);
    if (!what.empty() && observer.phase) observer.phase(what);
  } while (!is_running() && time_to_phase_event(world_) < kSameTime);
  if (!is_running()) return;
  begin_open_spaces(world_);
  if (observer.start) observer.start();
  begin_life(world_);
}

bool Simulation::remove_dying(const StepResult& failed, const Observer& observer) {
  const LifeReport removed = coupling::remove_dying(world_, work_, failed.cells, failed.cause);
  if (observer.life) observer.life(removed);
  return !removed.events.empty();
}

bool Simulation::run_events(const Observer& observer) {
  const LifeReport report = live(world_, work_);
  if (observer.life) observer.life(report);
  return !report.interrupted && (!observer.events_over || observer.events_over());
}

StepResult Simulation::take_step(double limit) {
  if (is_running() && is_change(world_.params, time())) start_anew(world_.state.clock);
  refresh_signals(world_, work_);
  update_guidance(world_.params, world_.state);
  return advance(world_, work_, awake_, limit);
}

bool Simulation::end_step(const StepResult& step, bool of_start_up, const Observer& observer) {
  if (!of_start_up) advance_substances(world_, step.step, substances_, work_.timings);
  if (observer.step) observer.step(step);
  if (of_start_up) {
    end_step_of_start_up(observer);
    return !observer.events_over || observer.events_over();
  }
  if (is_change(world_.params, time())) wake_all(world_);
  return run_events(observer);
}

LoopResult Simulation::run_until(double end, const Observer& observer) {
  bool of_start_up = false;
  const EventsDue& due = world_.state.clock.due;
  LoopResult result;
  if (due == EventsDue::kNone || run_events(observer))
    result = run_loop(
        {.time_left = [&] { return is_running() ? end - time() : kNever; },
         .advance =
             [&](double limit) {
               of_start_up = !is_running();
               return take_step(limit);
             },
         .time_to_event = [&] { return time_to_event(observer); },
         .after = [&](const StepResult& step) { return end_step(step, of_start_up, observer); },
         .recover = [&](const StepResult& failed) { return remove_dying(failed, observer); }});
  if (due != EventsDue::kNone) {
    result.ok = false;
    result.last.interrupted = true;
  }
  return result;
}

}  // namespace acinus::coupling
