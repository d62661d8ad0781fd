#pragma once
/// Run of a study in a child process.

#include <optional>
#include <string>

#include "io/file_lock.hpp"
#include "runs/session/child.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Progress as last printed by a run.
struct RunProgress {
  double time_s = 0, end_s = 0;  ///< simulated time, s
  double wall_s = 0;             ///< wall time since the start or resumption, s
  int dcm = 0, cbm = 0;          ///< number of cells
  std::string phase;             ///< phase of the simulation
  std::optional<double> left_s;  ///< own estimate of the remaining wall time, s
  bool starting = true;          ///< before t = 0, or before any progress
  bool printed = false;          ///< a progress line was printed
};

/// Options of every child process of a study.
struct ChildRunOptions {
  int threads = 1;
  double checkpoint_every_s = 120;  ///< wall time between checkpoints, s
};

/// Run in progress with its claim and its child process.
struct ActiveRun {
  std::size_t run = 0;  ///< index into the plan's runs
  io::FileLock claim;   ///< lock on the claim file of the run's folder
  Child child;
  std::string folder;
};

/// Starts a run in its folder, anew or from its checkpoint.
/// @param claim   taken by the caller
/// @param resume  continue from the checkpoint; false removes the files of an earlier attempt
/// @throws Error(kFileError)
ActiveRun start_run(const StudyPlan& plan, std::size_t run, const std::string& root,
                    io::FileLock claim, bool resume, const ChildRunOptions& options);

/// Parses one line of --progress json; missing members keep their defaults.
RunProgress parse_progress(const std::string& line);

/// Last line of a progress file, "" if there is none. Truncates a file that has grown long.
std::string take_progress_line(const std::string& file);

/// Progress of a run; the default if it has printed none.
RunProgress read_progress(const ActiveRun& run);

/// Last line of a text file, "" if there is none.
std::string last_line(const std::string& file);

/// Cause of a program's end: its stderr without warnings, at most 4000 bytes.
/// @param file  output of the program
/// @return "" if it printed nothing
std::string printed_cause(const std::string& file);

/// Removes all files of a run but its lock files.
void clear_run(const std::string& folder);

}  // namespace acinus::runs
