#pragma once
/// One run of a study while its process is alive.

#include <optional>
#include <string>

#include "io/file_lock.hpp"
#include "runs/session/child.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// What a running simulation last said about itself.
struct RunProgress {
  double time_s = 0, end_s = 0;  ///< simulated
  double wall_s = 0;             ///< since it was started or resumed
  int dcm = 0, cbm = 0;          ///< cells
  std::string phase;             ///< what it is busy with
  std::optional<double> left_s;  ///< wall time, by its own estimate
  bool starting = true;          ///< not yet at t = 0, or nothing said
  bool said = false;             ///< whether there was such a line
};

/// What every process of a study is told.
struct ChildRunOptions {
  int threads = 1;
  double checkpoint_every_s = 120;  ///< wall time that a kill may cost
};

struct ActiveRun {
  std::size_t run = 0;  ///< index into the plan's runs
  io::FileLock claim;   ///< of the run's folder
  Child child;
  std::string folder;
};

/// Starts a run in its folder, anew or from its checkpoint.
/// @param claim   held by the caller until now
/// @param resume  go on from the checkpoint; false removes what an earlier attempt left
/// @throws Error(kFileError)
ActiveRun start_run(const StudyPlan& plan, std::size_t run, const std::string& root,
                    io::FileLock claim, bool resume, const ChildRunOptions& options);

/// One line of --progress json; what it does not say has the default.
RunProgress parse_progress(const std::string& line);

/// The last line of a progress file, "" if none. Keeps the file that is read small.
std::string take_progress_line(const std::string& file);

/// Nothing said yet gives the default.
RunProgress read_progress(const ActiveRun& run);

/// The last line that a program printed, "" if none.
std::string last_line(const std::string& file);

/// Cause of a program's end: all that it printed on stderr but warnings.
/// @return "" if nothing
std::string printed_cause(const std::string& file);

/// Removes everything that a run left in its folder but the claim.
void clear_run(const std::string& folder);

}  // namespace acinus::runs
