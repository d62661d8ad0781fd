#pragma once
/// Selection and order of the runs of one process.

#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Part of a study that a process runs.
struct RunChoice {
  std::vector<std::string> only;  ///< variants, NAME/* allowed; empty = all
  int task = 1, tasks = 1;        ///< part `task` of `tasks`, from 1
};

/// Run chosen for this process.
struct ChosenRun {
  std::size_t run = 0;  ///< index into the plan's runs
  /// False: belongs to another task; run here only if one of ours waits for its start.
  bool own = true;
};

/// Chooses the runs of one process, seed by seed so that a partial study covers every variant; runs
/// that others start from come first, then expensive ones. Tasks get equal expected cost. The split
/// depends on the study alone. Runs that chosen ones start from are included.
/// @throws Error for a variant that does not exist
std::vector<ChosenRun> choose_runs(const StudyPlan& plan, const RunChoice& choice);

}  // namespace acinus::runs
