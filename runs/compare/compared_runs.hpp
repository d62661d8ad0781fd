#pragma once
/// Runs that are compared, the frames that all of them have, and how far each got.

#include <optional>
#include <string>
#include <vector>

#include "io/run_reader.hpp"
#include "runs/session/read_summary.hpp"

namespace acinus::runs {

struct ComparedRun {
  RunSummary summary;
  io::RunReader reader;
  std::vector<int> frame;  ///< those that all runs have

  double time_of_last() const { return reader.time_s(frame.back()); }  ///< s, of those
};

/// Opens runs and finds the frames at the same time in all of them: to a second, of short runs to a
/// thousandth of the first one's duration.
/// @param until  later frames are left out
/// @throws Error: a folder without a finished run, no frame in common
std::vector<ComparedRun> open_compared_runs(const std::vector<std::string>& folders,
                                            std::optional<double> until);

/// Reason why the last of the common frames is not the judged moment: the end of the run, or
/// `until`.
struct Shortfall {
  std::string why;   ///< empty: none
  bool own = false;  ///< the run itself did not get there; else others have no frame there
};
Shortfall find_shortfall(const ComparedRun& run, std::optional<double> until);

/// "2 of 9 frames of X are at times that all runs have"; empty: all of them are.
std::string describe_unshared_frames(const ComparedRun& run, std::optional<double> until);

}  // namespace acinus::runs
