#pragma once
/// Scheduler of the runs of a study as concurrent child processes.

#include <map>
#include <string>
#include <vector>

#include "runs/study/active_run.hpp"
#include "runs/study/choose_runs.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Options of the scheduler.
struct ScheduleOptions {
  std::string root;  ///< folder of the study
  int jobs = 1;      ///< concurrent processes
  ChildRunOptions child;
  bool overwrite = false;  ///< repeat failed runs and replace those of another scene or version
  bool quiet = false;
};

/// Numbers of completed, failed and remaining runs.
struct ScheduleResult {
  int done = 0, failed = 0, left = 0;
  bool stopped = false;  ///< by a signal
};

/// Runs all incomplete runs; stopped ones are resumed. No run is in two hands: this process holds
/// the claim of its folder and the child its run lock; runs of other processes are waited for. When
/// this process ends in any way, its children stop with a checkpoint. SIGTERM and SIGINT stop
/// everything.
/// @throws Error(kBadInput) before anything runs if results of another scene or version are in the
/// way and may not be replaced; Error(kFileError) for the disk
ScheduleResult run_all(const StudyPlan& plan, const std::vector<ChosenRun>& chosen,
                       const ScheduleOptions& options);

}  // namespace acinus::runs
