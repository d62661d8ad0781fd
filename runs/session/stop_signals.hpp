#pragma once
/// Signals that ask to stop: SIGTERM, SIGINT and SIGUSR1.

namespace acinus::runs {

/// While one of these lives such signals are counted and do nothing else. They nest: what a run
/// within a study was asked, the study was asked too.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// Number of the last one; 0 if none came since the outermost StopSignals was made.
int stop_signal();
/// How many came.
int count_stop_signals();

}  // namespace acinus::runs
