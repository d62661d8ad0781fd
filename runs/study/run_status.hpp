#pragma once
/// State of a run of a study, from the files of its folder.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// State of a run of a study.
enum class RunState {
  kToDo,
  kToResume,  ///< stopped or killed, with a checkpoint
  kRunning,   ///< another process holds the folder
  kDone,
  kFailed,   ///< the simulation could not continue
  kRefused,  ///< ended before its first checkpoint with an error
  kKilled,   ///< ended before its first checkpoint by a signal
  kStale,    ///< results of another scene or version
};
const char* name_of(RunState state);
/// True for a failed attempt. A refused or killed run may succeed at the next one.
bool has_failed(RunState state);
/// True for a run that the next start of the study takes up.
bool is_left(RunState state);

/// State of a run with its recorded figures.
struct RunStatus {
  RunState state = RunState::kToDo;
  std::string cause;  ///< cause of a failure or of the last attempt's end
  double cpu_s = 0, wall_s = 0, simulated_s = 0;  ///< as far as recorded
  std::string state_hash;                         ///< hash of the last recorded state
  std::string start_hash;  ///< hash of the state taken from another run; "" = its own or unknown
  std::string version, git;
};

/// Determines the state of a run from its folder.
/// @param root  folder of the study
/// @param held  the caller holds the run's claim, so that no other process can be running it
RunStatus inspect_run(const std::string& root, const StudyRun& run, bool held = false);

/// Outcome of the last attempt at an incomplete run.
struct AttemptEnd {
  std::string cause;  ///< "" = in progress
  bool killed = false;
};

/// Writes the record that identifies the run of a folder. Written before the first step.
void write_record(const std::string& root, const StudyPlan& plan, const StudyRun& run,
                  const AttemptEnd& end = {});

/// Path of the file whose lock marks a run as taken by a process.
std::string claim_file(const std::string& root, const StudyRun& run);

/// Message for a run that cannot start because its source run left no state at t = 0.
std::string describe_missing_start(const StudyRun& source, const RunStatus& status);

/// True if the folder of this very run holds the state at t = 0 for others.
bool has_start(const std::string& root, const StudyRun& run);

}  // namespace acinus::runs
