#pragma once
/// Options of one run: its folder, when it stops, what it prints.

#include <optional>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::runs {

struct RunOptions {
  std::string scene_file;
  std::vector<std::string> set;  ///< PATH=VALUE, already applied to the scene
  std::string out;               ///< run folder
  bool resume = false;           ///< go on from the checkpoint in `out`
  bool overwrite = false;        ///< results in `out` may be replaced
  coupling::Sharing sharing = coupling::Sharing::kBalanced;
  int threads = 0;                  ///< 0 = all cores
  std::optional<double> until_s;    ///< stop at this simulated time, s; empty = time.end
  std::optional<int> until_cells;   ///< stop at so many cells; empty = time.until_cells
  double checkpoint_every_s = 600;  ///< wall time, s
  /// Stop with a checkpoint when more is in use, bytes; empty = 95 % of the machine's.
  std::optional<double> max_memory;
  bool timings = false;        ///< print the time of each stage at the end
  bool quiet = false;          ///< no progress, warnings and errors only
  bool progress_json = false;  ///< progress as one JSON object a line
  bool is_part = false;      ///< of a larger job, which says itself how to go on when it is stopped
  std::string command_line;  ///< for the provenance
};

}  // namespace acinus::runs
