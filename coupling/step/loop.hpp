#pragma once
/// Loop over steps, the only one.

#include <functional>

#include "coupling/step/controller.hpp"

namespace acinus::coupling {

struct StepLoop {
  /// Time left, s; the loop ends at 0.
  std::function<double()> time_left;
  /// Advances by one accepted step no longer than its argument, s.
  std::function<StepResult(double limit)> advance;
  /// Time to the next event, s, which bounds the step. Empty: no events.
  std::function<double()> time_to_event = nullptr;
  /// Runs events and observers after an accepted step; false ends the loop. Empty: none.
  std::function<bool(const StepResult&)> after = nullptr;
  /// Removes the cause of a failed step; true if the step can be repeated. Empty: the loop ends.
  std::function<bool(const StepResult&)> recover = nullptr;
};

/// Outcome of a loop over steps.
struct LoopResult {
  bool ok = true;  ///< false: a step could not be accepted, or was interrupted
  int steps = 0;   ///< accepted steps
  StepResult last;
};

LoopResult run_loop(const StepLoop& loop);

/// Time left on a clock until `end`, s.
inline auto time_left_until(const Clock& clock, double end) {
  return [&clock, end] { return end - clock.time; };
}

}  // namespace acinus::coupling
