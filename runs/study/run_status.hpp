#pragma once
/// How far a run of a study is, from what stands in its folder.

#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

enum class RunState {
  kToDo,
  kToResume,  ///< stopped or killed, with a checkpoint
  kRunning,   ///< another process holds the folder
  kDone,
  kFailed,   ///< the simulation could not go on
  kRefused,  ///< ended before its first checkpoint, with an error
  kKilled,   ///< ended before its first checkpoint, by a signal
  kStale,    ///< results of another scene or version
};
const char* name_of(RunState state);
/// Test for a failed attempt; the next one of a run that was refused or killed may do better.
bool has_failed(RunState state);
/// Test for a run that the next start of the study takes up.
bool is_left(RunState state);

struct RunStatus {
  RunState state = RunState::kToDo;
  std::string cause;                              ///< of a failure, or why the last attempt ended
  double cpu_s = 0, wall_s = 0, simulated_s = 0;  ///< as far as the run told
  std::string state_hash;                         ///< of the last state told
  std::string start_hash;  ///< of the state it took from another run; "" = its own, or not told
  std::string version, git;
};

/// Looks at a run's folder.
/// @param root  the study's folder
/// @param held  the caller has the run's claim: no other process can be running it
RunStatus inspect_run(const std::string& root, const StudyRun& run, bool held = false);

/// End of the last attempt at a run that is not done.
struct AttemptEnd {
  std::string cause;  ///< "" = it goes on
  bool killed = false;
};

/// What a run folder says about whose it is, written before its first step.
void write_record(const std::string& root, const StudyPlan& plan, const StudyRun& run,
                  const AttemptEnd& end = {});

/// The file whose lock says that a process takes care of a run.
std::string claim_file(const std::string& root, const StudyRun& run);

/// Message for a run whose source, the run from whose start it goes on, left none.
std::string describe_missing_start(const StudyRun& source, const RunStatus& status);

/// Whether the state at t = 0 that others start from stands in the folder of this very run.
bool has_start(const std::string& root, const StudyRun& run);

}  // namespace acinus::runs
