#pragma once
/// Step-size control: attempts a step, accepts it, or rejects it and tries a shorter one.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// What came of a step.
struct StepResult {
  bool accepted = false;
  bool interrupted = false;         ///< not accepted because the process was asked to stop
  double step = 0;                  ///< s, length of the accepted step
  double error = 0;                 ///< um, its estimated error
  double max_move = 0;              ///< um
  int rejections = 0;               ///< attempts rejected before it
  std::string cause;                ///< why the last attempt was rejected
  std::vector<std::int64_t> cells;  ///< lineage ids of the cells concerned
};

/// Advances all cells by one accepted step no longer than `limit`, with as many shorter retries as
/// it takes; constrained cells go as the constraint says.
/// Not accepted: a step of min_step was still rejected, or the process was asked to stop
/// meanwhile; State is the last good one.
StepResult take_step(World& world, Workspace& work, double limit);

}  // namespace acinus::coupling
