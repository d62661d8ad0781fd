#pragma once
/// Options of one run: folder, stopping criteria, output.

#include <optional>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Options of one run.
struct RunOptions {
  std::string scene_file;
  std::vector<std::string> set;  ///< changes of the scene, PATH=VALUE, already applied
  std::string out;               ///< run folder
  bool resume = false;           ///< continue from the checkpoint in `out`
  bool overwrite = false;        ///< results in `out` may be replaced
  coupling::Sharing sharing = coupling::Sharing::kBalanced;
  int threads = 0;                  ///< 0 = all cores
  std::optional<double> until_s;    ///< simulated time to stop at, s; empty = time.end
  std::optional<int> until_cells;   ///< number of cells to stop at; empty = time.until_cells
  double checkpoint_every_s = 600;  ///< wall time between checkpoints, s
  /// Memory in use at which the run stops with a checkpoint, bytes; empty = 95 % of the machine's.
  std::optional<double> max_memory;
  bool timings = false;        ///< print the time of each stage at the end
  bool quiet = false;          ///< warnings and errors only, no progress
  bool verbose = false;        ///< print details of the computation
  bool progress_json = false;  ///< print progress as one JSON object a line
  bool is_part = false;        ///< part of a larger job, which itself explains how to resume it
  std::string command_line;    ///< recorded as provenance
};

}  // namespace acinus::runs
