#include "coupling/step/trial.hpp"

#include "coupling/step/stages.hpp"

namespace acinus::coupling {

void begin_trial(const World& world, Trial& trial) {
  trial.world = world;
  size_workspace(world, trial.friction);
  size_workspace(world, trial.work);
}

void move_trial(const World& world, std::span<const double> d, Trial& trial) {
  trial.world.state = world.state;
  move_points(trial.world.state, d);
}

}  // namespace acinus::coupling
