#pragma once
/// The only loop over steps.

#include <functional>

#include "coupling/step/controller.hpp"

namespace acinus::coupling {

struct StepLoop {
  /// One accepted step no longer than its argument, s.
  std::function<StepResult(double limit)> advance;
  /// Time to the next event, s: no step is longer. Empty: there are none.
  std::function<double()> time_to_event;
  /// Events and observers after an accepted step; false ends the loop. Empty: nothing.
  std::function<bool(const StepResult&)> after;
};

/// How a loop over steps ended.
struct LoopResult {
  bool ok = true;  ///< false: a step could not be accepted
  int steps = 0;   ///< accepted
  StepResult last;
};

/// Steps until the clock shows `end`, s, a step fails, or `after` says so.
LoopResult run_loop(const Clock& clock, double end, const StepLoop& loop);

}  // namespace acinus::coupling
