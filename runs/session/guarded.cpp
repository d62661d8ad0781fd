#include "runs/session/guarded.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.hpp"
#include "runs/session/exit_code.hpp"

namespace acinus::runs {
namespace {

/// Signals of crashes: out-of-bounds access, failed assertions, arithmetic faults.
constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
constexpr std::array kForwardedSignals{SIGTERM, SIGINT, SIGUSR1, SIGHUP, SIGQUIT};

/// Blocks signals so that they can be waited for instead of taking effect.
class SignalsTaken {
 public:
  SignalsTaken() {
    sigemptyset(&taken_);
    sigaddset(&taken_, SIGCHLD);
    for (const int signal : kForwardedSignals) sigaddset(&taken_, signal);
    sigprocmask(SIG_BLOCK, &taken_, &before_);
  }
  ~SignalsTaken() { give_back(); }
  SignalsTaken(const SignalsTaken&) = delete;
  SignalsTaken& operator=(const SignalsTaken&) = delete;
  void give_back() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  int wait(siginfo_t& info) const { return sigwaitinfo(&taken_, &info); }

 private:
  sigset_t taken_{}, before_{};
};

/// Forwards signals to the child until it has ended.
/// @return its wait status
int wait_for(pid_t child, const SignalsTaken& signals) {
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return status;
    siginfo_t info{};
    const int signal = signals.wait(info);
    // Those of the terminal reach the child anyway.
    if (signal > 0 && signal != SIGCHLD && info.si_code != SI_KERNEL) kill(child, signal);
  }
}

}  // namespace

int run_guarded(const std::string& files, const std::function<int()>& work) {
  std::fflush(nullptr);
  const SignalsTaken signals;
  const pid_t parent = getpid(), child = fork();
  check(child >= 0,
        fmt::format("cannot start another process: {}. Are there too many?", std::strerror(errno)),
        Exit::kFileError);
  if (child == 0) {
    signals.give_back();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(static_cast<int>(Exit::kStopped));
    const int code = exit_code_of(work);  // exceptions do not cross processes
    std::fflush(nullptr);
    _exit(code);
  }
  const int status = wait_for(child, signals);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const int signal = WTERMSIG(status);
  check(std::ranges::find(kCrashSignals, signal) == kCrashSignals.end(),
        fmt::format("{}: reading ended with signal {} ({}). A file there is damaged in a way that "
                    "the reader of its format does not bear. Use an intact copy.",
                    files, signal, strsignal(signal)),
        Exit::kFileError);
  // Asked to end, or out of memory: as it would have been without a child.
  ::signal(signal, SIG_DFL);
  signals.give_back();
  raise(signal);
  return static_cast<int>(Exit::kStopped);
}

}  // namespace acinus::runs
