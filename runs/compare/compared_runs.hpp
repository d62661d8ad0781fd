#pragma once
/// Runs to compare, their common frames and their end.

#include <optional>
#include <string>
#include <vector>

#include "io/run_reader.hpp"
#include "runs/session/read_summary.hpp"

namespace acinus::runs {

/// Run with its summary and the frames to compare.
struct ComparedRun {
  RunSummary summary;
  io::RunReader reader;
  std::vector<int> frame;  ///< frames that all runs have

  double time_of_last() const {
    return reader.time_s(frame.back());
  }  ///< time of the last common frame, s
};

/// Opens runs and matches their frames by time, with a tolerance of 1e-3 of the first run's
/// duration, at most 1 s.
/// @param until  ignores later frames, s
/// @throws Error for a folder without a finished run, or no common frame
std::vector<ComparedRun> open_compared_runs(const std::vector<std::string>& folders,
                                            std::optional<double> until);

/// Reason why the last common frame is not at the judged time (`until` if given, else the end).
struct Shortfall {
  std::string why;   ///< empty: none
  bool own = false;  ///< the run itself ended early; else others have no frame there
};
Shortfall find_shortfall(const ComparedRun& run, std::optional<double> until);

/// Note on frames without a counterpart: "2 of 9 frames of X are at times that all runs have".
/// Empty if all frames are shared.
std::string describe_unshared_frames(const ComparedRun& run, std::optional<double> until);

}  // namespace acinus::runs
