#pragma once
/// Progress of a run: one line on a terminal, one line a minute otherwise and with several
/// processes, or JSON lines.

#include <string>

#include "coupling/world/world.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/time_left.hpp"

namespace acinus::runs {

/// Printer of the progress of a run, and its logger.
class Progress {
 public:
  /// Progress of a run until `end` (s since t = 0). Only the first of several processes prints.
  Progress(const RunOptions& options, double end, const Ranks& ranks);
  /// Starts the estimate of rate and time left here: a resumed run did not simulate its past in
  /// this process.
  void begin(const coupling::World& world);
  /// Prints if a line is due. Called after every step.
  void step(const coupling::World& world);
  /// Clears the progress line on the terminal.
  void finish();
  /// Prints a message on a line of its own and logs it.
  void note(const std::string& text);
  /// Logs a detail of the computation, and prints it if the run is verbose.
  void detail(const std::string& text);
  /// Prints a warning to stderr, also of a quiet run, and logs it.
  void warn(const std::string& text);

 private:
  void print(const coupling::World& world);
  std::string line_of(const coupling::World& world) const;

  const RunOptions& options_;
  Ranks ranks_;
  double end_, started_, last_ = -1e300;
  coupling::Phase phase_ = coupling::Phase::kRun;
  TimeLeft left_;  ///< for the present phase
  bool terminal_, line_open_ = false;
};

}  // namespace acinus::runs
