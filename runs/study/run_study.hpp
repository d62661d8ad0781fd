#pragma once
/// `acinus study`.

#include <string>

#include "runs/study/active_run.hpp"
#include "runs/study/choose_runs.hpp"

namespace acinus::runs {

struct StudyOptions {
  std::string file;  ///< study file, or the name of a shipped study
  std::string out;   ///< "" = <study name>.study in this folder
  int jobs = 0;      ///< processes at once; 0 = cores over threads
  ChildRunOptions child;
  RunChoice choice;
  bool dry_run = false;      ///< list runs and their expected cost, run nothing
  bool report_only = false;  ///< report from what is there, run nothing
  bool overwrite = false;    ///< run again what failed or is of another scene or version
  bool quiet = false;
};

/// Runs a study, or the part of it that is asked for, and reports.
/// @return exit code: 0 all chosen runs are done, 3 some could not go on, 75 stopped
/// @throws Error for a bad study, a folder of something else, the disk
int run_study(StudyOptions options);

}  // namespace acinus::runs
