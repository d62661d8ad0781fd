#pragma once
/// One simulation from the command line's point of view.

#include "runs/scene/scene.hpp"
#include "runs/session/run_options.hpp"

namespace acinus::runs {

/// Runs a scene until its end, a signal, a WallTimeLimit or a failure.
/// @return the process exit code: 0 done, 3 cannot continue, 75 stopped with a checkpoint
/// @throws Error for user and disk errors
int run_scene(const Scene& scene, const RunOptions& options);

}  // namespace acinus::runs
