#pragma once
/// Step-size control: attempts a step, accepts it, or rejects it and tries a shorter one.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/step/late_cells.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Outcome of a step.
struct StepResult {
  bool accepted = false;
  bool interrupted = false;         ///< not accepted, since the process was asked to stop
  double step = 0;                  ///< s, length of the accepted step
  double error = 0;                 ///< um, its estimated error
  double max_move = 0;              ///< um, largest displacement
  int rejections = 0;               ///< rejected attempts before it
  std::string cause;                ///< cause of the last rejection
  std::vector<std::int64_t> cells;  ///< lineages of the cells that caused it
};

/// Advances all cells by one accepted step no longer than `limit`, after as many shorter retries as
/// needed. Constrained cells follow the constraint.
/// @param late  steps of late cells; null: all cells take the same steps
/// @return not accepted if a step of min_step was rejected or the process was asked to stop; State
/// is then the last accepted one
StepResult take_step(World& world, Workspace& work, double limit, const LateSteps* late = nullptr);

}  // namespace acinus::coupling
