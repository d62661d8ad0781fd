#include "coupling/step/loop.hpp"

#include <algorithm>

#include "core/numbers/time_grid.hpp"

namespace acinus::coupling {

LoopResult run_loop(const StepLoop& loop) {
  LoopResult result;
  for (double left = loop.time_left(); left > kSameTime; left = loop.time_left()) {
    const double event = loop.time_to_event ? loop.time_to_event() : left;
    result.last = loop.advance(std::min(left, event));
    if (!result.last.accepted) {
      if (!result.last.interrupted && loop.recover && loop.recover(result.last)) continue;
      result.ok = false;
      break;
    }
    ++result.steps;
    if (loop.after && !loop.after(result.last)) break;
  }
  return result;
}

}  // namespace acinus::coupling
