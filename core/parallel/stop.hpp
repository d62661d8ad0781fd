#pragma once
/// Requests to stop a process: signals and a limit on its wall time. Both reach the process as a
/// whole, so this is the one state that is global; long computations poll it.

#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace acinus {

/// Signals that ask a process to stop: all whose default ends it, except crashes (SIGSEGV, SIGABRT
/// and so on), SIGKILL, SIGPIPE and SIGXFSZ. The last two show as failed writes.
std::vector<int> stop_signals();

/// Handler of stop signals while it lives. An ignored signal stays ignored (nohup), except SIGINT
/// and SIGQUIT, which shells ignore for every job in the background; handlers of other code stay
/// too, except those of SIGINT, SIGQUIT and SIGTERM.
class SignalHandlers {
 public:
  explicit SignalHandlers(void (*handler)(int));
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
};

/// Counter of stop signals, which have no other effect while it lives. Counters nest: a signal to a
/// run within a study counts for the study too.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  std::optional<SignalHandlers> handlers_;  ///< of the outermost
};

/// Number of stop signals since the outermost StopSignals was made.
int count_stop_signals();

/// Limit on the wall time, counted from its construction, in force while it lives. Limits nest: the
/// earliest applies.
class WallTimeLimit {
 public:
  /// Starts the limit. @param limit_s  infinite: none
  explicit WallTimeLimit(double limit_s);
  ~WallTimeLimit();
  WallTimeLimit(const WallTimeLimit&) = delete;
  WallTimeLimit& operator=(const WallTimeLimit&) = delete;

 private:
  double before_;
};

/// True if a stop signal was counted or the limit has passed: the computation must end and save its
/// state. Among processes that share a run: true if one of them was asked, as last agreed.
bool stop_requested();
/// Reason of the request: "signal 15 (SIGTERM)", "the wall-time limit"; empty: none.
std::string describe_stop();

/// True if this process itself was asked; input of the agreement among processes.
bool is_asked_to_stop();
/// Sets the agreed answer of stop_requested(), which holds from the first call on: all processes
/// see it change at the same place.
void agree_to_stop(bool stop);

/// Ends the program with exit code 75 at the wall-time limit, while it lives and there is nothing
/// to save yet.
class ExitAtLimit {
 public:
  ExitAtLimit();
  ~ExitAtLimit();
  ExitAtLimit(const ExitAtLimit&) = delete;
  ExitAtLimit& operator=(const ExitAtLimit&) = delete;

 private:
  struct sigaction before_ {};
};

/// Ends the program with exit code 75 at a stop signal, while it lives and there is nothing to save
/// yet.
class ExitAtSignal {
 public:
  ExitAtSignal();

 private:
  SignalHandlers handlers_;
};

}  // namespace acinus
