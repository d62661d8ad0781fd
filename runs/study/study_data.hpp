#pragma once
/// Recorded data of the runs of a study.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "runs/study/curves.hpp"
#include "runs/study/plan.hpp"
#include "runs/study/run_status.hpp"

namespace acinus::runs {

/// Status and recorded curves of one run.
struct RunData {
  RunStatus status;
  std::map<std::string, TimeCurve> curve;  ///< by observable, in the plan's units
  double until = 0;                        ///< time of the last row, s
};

/// Data of every run, in the order of the plan.
using StudyData = std::vector<RunData>;

/// Reads the data of all runs, including those in progress. Missing values are omitted; read errors
/// are reported in the cause of the run's status.
StudyData read_study_data(const StudyPlan& plan, const std::string& root);

/// Writes table.csv and table.h5 with the columns run, variant, seed, time_s, observable, value,
/// unit, in the order of the plan, by observable, by time. Their content is independent of when and
/// where runs were made.
/// @throws Error(kFileError)
void write_table(const StudyPlan& plan, const StudyData& data, const std::string& root);

/// Writes runs.csv: state, times and cost of every run.
/// @throws Error(kFileError)
void write_runs(const StudyPlan& plan, const StudyData& data, const std::string& root);

}  // namespace acinus::runs
