#include "coupling/step/loop.hpp"

#include <algorithm>

#include "core/time_grid.hpp"

namespace acinus::coupling {

LoopResult run_loop(const Clock& clock, double end, const StepLoop& loop) {
  LoopResult result;
  while (clock.time < end - kSameTime) {
    double limit = end - clock.time;
    if (loop.time_to_event) limit = std::min(limit, loop.time_to_event());
    result.last = loop.advance(limit);
    result.ok = result.last.accepted;
    if (!result.ok) break;
    ++result.steps;
    if (loop.after && !loop.after(result.last)) break;
  }
  return result;
}

}  // namespace acinus::coupling
