#pragma once
/// Which runs a process takes, and in which order.

#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

struct RunChoice {
  std::vector<std::string> only;  ///< variants, NAME/* allowed; empty = all
  int task = 1, tasks = 1;        ///< part `task` of `tasks`, from 1
};

struct ChosenRun {
  std::size_t run = 0;  ///< index into the plan's runs
  bool own = true;      ///< false: run here only if one of ours waits for its start
};

/// The runs of one process: seed by seed, so that a study cut short has something of everything;
/// those that others start from first, then the expensive ones. Tasks get equal expected cost; the
/// split depends on the study alone. Runs that the chosen ones start from are among them.
/// @throws Error for a variant that does not exist
std::vector<ChosenRun> choose_runs(const StudyPlan& plan, const RunChoice& choice);

}  // namespace acinus::runs
