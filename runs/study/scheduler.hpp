#pragma once
/// Runs the simulations of a study as processes of this program, several at once.

#include <map>
#include <string>
#include <vector>

#include "runs/study/active_run.hpp"
#include "runs/study/choose_runs.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

struct ScheduleOptions {
  std::string root;  ///< the study's folder
  int jobs = 1;      ///< processes at once
  ChildRunOptions child;
  bool overwrite =
      false;  ///< run again what failed and what was made from another scene or version
  bool quiet = false;
};

/// What came of the chosen runs.
struct ScheduleResult {
  int done = 0, failed = 0, left = 0;
  bool stopped = false;  ///< by a signal
};

/// Runs what is not done yet, resumes what was stopped. A run is never in two hands: the folder's
/// claim is held here, its lock by the process that writes in it; what another process has is
/// waited for. Children stop with a checkpoint when this process ends, however it ends. SIGTERM and
/// SIGINT stop everything.
/// @throws Error(kBadInput) before anything runs if results of another scene or version are in the
///         way and may not be replaced; Error(kFileError) for the disk
ScheduleResult run_all(const StudyPlan& plan, const std::vector<ChosenRun>& chosen,
                       const ScheduleOptions& options);

}  // namespace acinus::runs
