#pragma once
/// Figures of a finished run, read from its summary.json.

#include <string>
#include <vector>

#include "runs/experiments/measures.hpp"
#include "runs/session/run_outcome.hpp"

namespace acinus::runs {

/// Figures of a finished run.
struct RunSummary {
  std::string folder;
  std::string scene, hash, version, git;
  RunOutcome status = RunOutcome::kFailed;
  std::string cause;       ///< cause of a failure or stop; "" = none
  std::string state_hash;  ///< hash of the final state
  /// Hash of the state at t = 0 taken from another run; "" = its own start.
  std::string start_hash;
  double simulated_s = 0, wall_s = 0, cpu_s = 0;
  int dcm = 0, cbm = 0;  ///< number of cells at the end
  Measures measures;     ///< NaN for missing values
};

/// Reads summary.json of a run folder.
/// @throws Error naming file and key: kFileError if the file cannot be read, kBadInput if it is no
/// summary
RunSummary read_summary(const std::string& folder);

/// Time series of the run by name, [n_frame].
/// @throws Error(kBadInput) if the run did not measure it
const std::vector<double>& series(const RunSummary& run, const std::string& name);

}  // namespace acinus::runs
