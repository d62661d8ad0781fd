#pragma once
/// What the runs of a study have measured so far.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "runs/study/curves.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/run_status.hpp"

namespace acinus::runs {

struct RunData {
  RunStatus status;
  std::map<std::string, TimeCurve> curve;  ///< by observable, in the plan's units
  double until = 0;                        ///< s, of the last row; nothing is known later
};

/// One per run of the plan, in its order.
using StudyData = std::vector<RunData>;

/// Reads all runs, also those that still go on. Values that do not exist are left out; what cannot
/// be read is told in the status' cause.
StudyData read_study_data(const StudyPlan& plan, const std::string& root);

/// Writes table.csv and table.h5: run, variant, seed, time_s, observable, value, unit, in the order
/// of the plan, by observable, by time. Nothing in them depends on when and where runs were made.
/// @throws Error(kFileError)
void write_table(const StudyPlan& plan, const StudyData& data, const std::string& root);

/// Writes runs.csv: state, times and cost of every run.   @throws Error(kFileError)
void write_runs(const StudyPlan& plan, const StudyData& data, const std::string& root);

}  // namespace acinus::runs
