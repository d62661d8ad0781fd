#pragma once
/// Progress of a run: one line on a terminal, one line a minute otherwise and from several
/// processes, or JSON lines.

#include <string>

#include "coupling/world/world.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/time_left.hpp"

namespace acinus::runs {

class Progress {
 public:
  /// Of several processes only the first one speaks.
  Progress(const RunOptions& options, double end, const Ranks& ranks);
  /// Rate and time left count from here: a resumed run has not simulated its past in this process.
  void begin(const coupling::World& world);
  /// Called after every step; prints when it is time to.
  void step(const coupling::World& world);
  /// Ends the terminal line.
  void finish();
  /// A message of its own line, also to the log.
  void note(const std::string& text);
  /// A warning: to stderr, also of a quiet run, and to the log.
  void warn(const std::string& text);

 private:
  void print(const coupling::World& world);

  const RunOptions& options_;
  Ranks ranks_;
  double end_, started_, last_ = -1e300;
  coupling::Phase phase_ = coupling::Phase::kRun;
  TimeLeft left_;  ///< of the phase
  bool terminal_, line_open_ = false;
};

}  // namespace acinus::runs
