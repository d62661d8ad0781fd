#pragma once
/// One simulation from the command line's point of view.

#include <optional>
#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

struct RunOptions {
  std::string scene_file;
  std::vector<std::string> set;          ///< PATH=VALUE, already applied to the scene
  std::string out;                       ///< run folder
  bool resume = false;                   ///< go on from the checkpoint in `out`
  bool overwrite = false;                ///< results in `out` may be replaced
  int threads = 0;                       ///< 0 = all cores
  std::optional<double> until_s;         ///< stop at this simulated time, s; empty = time.end
  std::optional<int> until_cells;        ///< stop at so many cells; empty = time.until_cells
  double checkpoint_every_s = 600;       ///< wall time, s
  std::optional<double> max_walltime_s;  ///< stop with a checkpoint after this wall time, s
  bool timings = false;                  ///< print the time of each stage at the end
  bool quiet = false;                    ///< no progress, warnings and errors only
  bool progress_json = false;            ///< progress as one JSON object a line
  bool is_part = false;      ///< of a larger job, which says itself how to go on when it is stopped
  std::string command_line;  ///< for the provenance
};

/// Runs a scene until its end, a signal, a wall-time limit or a failure.
/// @return the process exit code: 0 done, 3 cannot continue, 75 stopped with a checkpoint
/// @throws Error for user and disk errors
int run_scene(const Scene& scene, const RunOptions& options);

}  // namespace acinus::runs
