#pragma once
/// The numbers of a finished run, read back from its summary.json.

#include <string>
#include <vector>

#include "runs/experiments/measures.hpp"

namespace acinus::runs {

struct RunSummary {
  std::string folder;
  std::string scene, hash, version, git, status;
  std::string cause;       ///< of a failure or stop; "" = none
  std::string state_hash;  ///< of the final state
  std::string start_hash;  ///< of the state at t = 0 that another run left; "" = its own
  double simulated_s = 0, wall_s = 0, cpu_s = 0;
  int dcm = 0, cbm = 0;  ///< cells at the end
  Measures measures;     ///< NaN where there was no value
};

/// @throws Error naming file and key: kFileError if it cannot be read, kBadInput if it is no
/// summary
RunSummary read_summary(const std::string& folder);

/// A series of the run. @throws Error(kBadInput) if the run did not measure it
const std::vector<double>& series(const RunSummary& run, const std::string& name);

}  // namespace acinus::runs
