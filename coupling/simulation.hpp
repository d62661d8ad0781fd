#pragma once
/// The driver of a hybrid world: start-up and run, steps, the events between steps, observers.

#include <functional>
#include <string>

#include "coupling/life/life.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Looks at a simulation on its way and changes nothing. What is empty is not called.
struct Observer {
  /// The next moment after `time` at which a step has to end, both s since t = 0. Not asked during
  /// start-up.
  std::function<double(double time)> next_moment = nullptr;
  /// A step was accepted; events are to come.
  std::function<void(const StepResult&)> step = nullptr;
  /// A phase of start-up ended: what happened, in words.
  std::function<void(const std::string& what)> phase = nullptr;
  /// t = 0: cells have not begun to live yet. Other runs may start from this state.
  std::function<void()> start = nullptr;
  /// Cells were born, died or got better meshes. The daughters are where they were born.
  std::function<void(const LifeReport&)> life = nullptr;
  /// Events are over. @return false: the simulation is to end here
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

  /// To be called after cells were added, removed or changed from outside.
  void resize();

  /// Steps with all events until `end`, s since t = 0, through start-up where there is one.
  /// Not ok: a step could not be accepted, or was interrupted as the process was asked to stop; the
  /// state is the last good one. A step that fails at cells that dissolve removes them and is taken
  /// again.
  LoopResult run_until(double end, const Observer& observer = {});

 private:
  /// State of the run before the last step.
  struct LastStep {
    bool was_running = false;
    double change = 0;  ///< s since t = 0, next discontinuity of what acts on the cells
  };

  double time_to_event(const Observer& observer) const;
  StepResult take_step(double limit, LastStep& last);
  /// Observers and events after a step. @return false: the simulation is to end here
  bool end_step(const StepResult& step, const LastStep& last, const Observer& observer);
  void end_step_of_start_up(const Observer& observer);
  bool run_events(const Observer& observer);
  bool remove_dying(const StepResult& failed, const Observer& observer);

  World world_;
  Workspace work_;
  AwakePart awake_;
};

}  // namespace acinus::coupling
