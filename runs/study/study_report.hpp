#pragma once
/// Report on the runs of a study, from the files of its folder.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Numbers of claims by verdict and of runs by state.
struct ReportCounts {
  int holds = 0, does_not_hold = 0, not_measured = 0;
  int done = 0, failed = 0, missing = 0;  ///< runs
};

/// Reads all runs and writes table.csv, table.h5, runs.csv, plots/, verdicts.json and report.md.
/// @throws Error(kFileError)
ReportCounts write_study_report(const StudyPlan& plan, const std::string& root);

}  // namespace acinus::runs
