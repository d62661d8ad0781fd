#pragma once
/// One simulation in its run folder, as the command line starts it.

#include "runs/scene/scene.hpp"
#include "runs/session/run_options.hpp"

namespace acinus::runs {

/// Runs a scene to its end, a stopping criterion, a signal, a WallTimeLimit or a failure.
/// @return exit code: 0 done, 3 cannot continue, 75 stopped with a checkpoint
/// @throws Error for user and disk errors
int run_scene(const Scene& scene, const RunOptions& options);

}  // namespace acinus::runs
