#pragma once
/// Study as a whole: its runs and its report (`acinus study`).

#include <string>

#include "runs/study/active_run.hpp"
#include "runs/study/choose_runs.hpp"

namespace acinus::runs {

/// Options of `acinus study`.
struct StudyOptions {
  std::string file;  ///< study file, or name of a shipped study
  std::string out;   ///< folder of the study; "" = <study name>.study in the working directory
  int jobs = 0;      ///< concurrent processes; 0 = cores over threads
  ChildRunOptions child;
  RunChoice choice;
  bool dry_run = false;      ///< list the runs and their expected cost only
  bool report_only = false;  ///< report on existing results only
  bool overwrite = false;    ///< repeat failed runs and runs of another scene or version
  bool quiet = false;
};

/// Runs a study or the chosen part of it, and writes its report.
/// @return exit code: 0 all chosen runs are complete, 3 some could not continue, 75 stopped
/// @throws Error for a faulty study, a folder of something else, the disk
int run_study(StudyOptions options);

}  // namespace acinus::runs
