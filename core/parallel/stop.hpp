#pragma once
/// What asks a process to stop: signals and a limit on its wall time. Both reach the process as a
/// whole, so this is the one state that is not passed around; long computations look at it.

#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace acinus {

/// The signals that ask a process to stop: all whose default ends it, but for crashes (SIGSEGV,
/// SIGABRT and so on), SIGKILL, SIGPIPE and SIGXFSZ. The last two show as failed writes.
std::vector<int> stop_signals();

/// Gives stop signals a handler while it lives. A signal that was ignored stays so (nohup), but for
/// SIGINT and SIGQUIT, which shells ignore for every job in the background; a handler of somebody
/// else stays too, but for those of SIGINT, SIGQUIT and SIGTERM.
class SignalHandlers {
 public:
  explicit SignalHandlers(void (*handler)(int));
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
};

/// Counter of stop signals, which do nothing else while it lives. Counters nest: a signal to a run
/// within a study counts for the study too.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  std::optional<SignalHandlers> handlers_;  ///< of the outermost
};

/// How many came since the outermost StopSignals was made.
int count_stop_signals();

/// A limit on the wall time, from its making on, in force while it lives. They nest: the earliest
/// counts.
class WallTimeLimit {
 public:
  /// @param limit_s  infinite: none
  explicit WallTimeLimit(double limit_s);
  ~WallTimeLimit();
  WallTimeLimit(const WallTimeLimit&) = delete;
  WallTimeLimit& operator=(const WallTimeLimit&) = delete;

 private:
  double before_;
};

/// Whether a signal was counted or the limit has passed: what goes on must come to an end, and what
/// is there be saved. Of processes that share a run: whether one of them was, as they agreed.
bool stop_requested();
/// "signal 15 (SIGTERM)", "the wall-time limit"; empty: none.
std::string describe_stop();

/// Whether this process was, whatever others know. For what makes them agree.
bool is_asked_to_stop();
/// From the first call on stop_requested() says what was agreed last, so that all processes see it
/// change at the same place.
void agree_to_stop(bool stop);

/// While one of these lives, and there is nothing to save yet, the program ends at the limit with
/// exit code 75, whatever it is busy with.
class ExitAtLimit {
 public:
  ExitAtLimit();
  ~ExitAtLimit();
  ExitAtLimit(const ExitAtLimit&) = delete;
  ExitAtLimit& operator=(const ExitAtLimit&) = delete;

 private:
  struct sigaction before_ {};
};

/// Exit with code 75 at a stop signal while it lives and there is nothing to save yet.
class ExitAtSignal {
 public:
  ExitAtSignal();

 private:
  SignalHandlers handlers_;
};

}  // namespace acinus
