#pragma once
/// A run that is one part of a larger job: started, taken up again, or found done.

#include <optional>
#include <string>

#include "runs/scene/scene.hpp"
#include "runs/session/read_summary.hpp"

namespace acinus::runs {

struct StageOptions {
  std::string folder;
  int threads = 0;  ///< 0 = all cores
  bool quiet = false;
  bool fresh = false;  ///< run it anew whatever stands in the folder
  std::string command_line;
};

/// What stands in the folder, if it is a run of this scene by this version.
std::optional<RunSummary> find_run(const Scene& scene, const std::string& folder);

/// Runs a scene to its end. Does nothing if that was done before; goes on from a checkpoint if the
/// run was stopped.
/// @return its exit code, that of the earlier run if nothing was to do
int run_stage(const Scene& scene, const StageOptions& options);

}  // namespace acinus::runs
