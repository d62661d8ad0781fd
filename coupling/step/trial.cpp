#include "coupling/step/trial.hpp"

#include <memory>

#include "coupling/step/stages.hpp"

namespace acinus::coupling {

Trial& make_trial(const World& world, Workspace& w) {
  if (!w.trial) {
    w.trial = std::make_shared<Trial>();
    w.trial->world = world;
    size_workspace(world, w.trial->friction);
    size_workspace(world, w.trial->work);
  }
  return *w.trial;
}

void move_trial(const World& world, std::span<const double> d, Trial& trial) {
  trial.world.state = world.state;
  move_points(trial.world.state, d);
}

}  // namespace acinus::coupling
