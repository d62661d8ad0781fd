#pragma once
/// The only loop over steps.

#include <functional>

#include "coupling/step/controller.hpp"

namespace acinus::coupling {

struct StepLoop {
  /// s; the loop ends when nothing is left.
  std::function<double()> time_left;
  /// One accepted step no longer than its argument, s.
  std::function<StepResult(double limit)> advance;
  /// Time to the next event, s: no step is longer. Empty: there are none.
  std::function<double()> time_to_event = nullptr;
  /// Events and observers after an accepted step; false ends the loop. Empty: nothing.
  std::function<bool(const StepResult&)> after = nullptr;
  /// Removes the cause of a step that could not be accepted; true if it is to be tried again.
  /// Empty: the loop ends.
  std::function<bool(const StepResult&)> recover = nullptr;
};

/// How a loop over steps ended.
struct LoopResult {
  bool ok = true;  ///< false: a step could not be accepted, or was interrupted
  int steps = 0;   ///< accepted
  StepResult last;
};

LoopResult run_loop(const StepLoop& loop);

/// What is left of a clock's time until it shows `end`, s.
inline auto time_left_until(const Clock& clock, double end) {
  return [&clock, end] { return end - clock.time; };
}

}  // namespace acinus::coupling
