#pragma once
/// Driver of a hybrid world: start-up, steps, the events between steps, observers.

#include <functional>
#include <string>

#include "coupling/life/life.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Observer of a simulation: call-backs that read the world and do not change it. Empty ones are
/// not called.
struct Observer {
  /// Next time after `time` at which a step has to end, both s since t = 0. Not called during
  /// start-up.
  std::function<double(double time)> next_moment = nullptr;
  /// Called after an accepted step, before its events.
  std::function<void(const StepResult&)> step = nullptr;
  /// Called at the end of a phase of start-up, with a message.
  std::function<void(const std::string& what)> phase = nullptr;
  /// Called at t = 0, before begin_life: the state that other runs may start from.
  std::function<void()> start = nullptr;
  /// Called after births, deaths and mesh repair. Daughters are at their places of birth.
  std::function<void(const LifeReport&)> life = nullptr;
  /// Called after all events of a step.   @return false to end the simulation here
  std::function<bool()> events_over = nullptr;
};

class Simulation {
 public:
  explicit Simulation(World world);

  World& world() { return world_; }
  const World& world() const { return world_; }
  Workspace& work() { return work_; }
  const Workspace& work() const { return work_; }
  double time() const { return time_since_start(world_); }  ///< s since t = 0
  bool is_running() const { return world_.state.clock.phase == Phase::kRun; }

  /// Sizes the workspace anew. Call it after cells were added, removed or changed from outside.
  void resize();

  /// Gives every process the points of all cells, before they are measured. Collective.
  void complete_points();
  /// Brings the points of the cells near own ones, and returns the memory of others: all processes
  /// have what measures read. Collective.
  void refresh_points();

  /// Advances with all events until `end`, s since t = 0, through start-up if it is not over. A
  /// step that fails at dissolving cells removes them and is repeated.
  /// @return not ok if a step could not be accepted or the process was asked to stop; the state is
  /// then the last accepted one
  LoopResult run_until(double end, const Observer& observer = {});

 private:
  double time_to_event(const Observer& observer) const;
  StepResult take_step(double limit);
  /// Calls observers and events after a step.
  /// @param of_start_up  the step began before t = 0
  /// @return false to end the simulation here
  bool end_step(const StepResult& step, bool of_start_up, const Observer& observer);
  void end_step_of_start_up(const Observer& observer);
  bool run_events(const Observer& observer);
  bool remove_dying(const StepResult& failed, const Observer& observer);

  World world_;
  Workspace work_;
  AwakePart awake_;
  SubstanceWorkspace substances_;
};

}  // namespace acinus::coupling
