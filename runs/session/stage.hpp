#pragma once
/// One run as a stage of a larger job: started, resumed, or found complete.

#include <optional>
#include <string>

#include "runs/scene/scene.hpp"
#include "runs/session/read_summary.hpp"

namespace acinus::runs {

/// Options of a run as a stage.
struct StageOptions {
  std::string folder;
  int threads = 0;  ///< 0 = all cores
  bool quiet = false;
  bool fresh = false;  ///< run it anew whatever the folder holds
  std::string command_line;
};

/// Summary of the run in a folder if it is of this scene and this version of the program.
std::optional<RunSummary> find_run(const Scene& scene, const std::string& folder);

/// Runs a scene to its end. A complete run is not repeated; a stopped one is resumed from its
/// checkpoint.
/// @return exit code, that of the earlier run if it was complete
int run_stage(const Scene& scene, const StageOptions& options);

}  // namespace acinus::runs
