#pragma once
/// States on the way of a step and what is assembled there, for methods with more than one stage.

#include <span>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct Trial {
  World world;         ///< the step's world with other positions
  Workspace friction;  ///< Gamma at the start of the step
  Workspace work;      ///< at the trial positions
  std::vector<double> first, product;
};

/// Begins a trial at the present positions.
void begin_trial(const World& world, Trial& trial);

/// Everything as in `world`, all points moved by d, um.
void move_trial(const World& world, std::span<const double> d, Trial& trial);

}  // namespace acinus::coupling
