#include "runs/session/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/clock.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kThreads = "OMP_NUM_THREADS";

/// Prefixes of the environment variables by which MPI launchers connect their processes; a child
/// must not inherit them.
constexpr std::array kLaunchers = {"OMPI_", "PMI_", "PMIX_", "SLURM_STEP_NUM_TASKS="};

/// Environment of a child: that of this process, with one thread and without MPI.
std::vector<std::string> environment() {
  std::vector<std::string> all{std::string(kThreads) + "=1"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    if (!variable.starts_with(kThreads) &&
        std::ranges::none_of(kLaunchers, [&](const char* l) { return variable.starts_with(l); }))
      all.emplace_back(variable);
  }
  return all;
}

int open_output(const std::string& path) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  check(descriptor >= 0, fmt::format("{}: cannot be written: {}", path, std::strerror(errno)),
        Exit::kFileError);
  return descriptor;
}

/// Blocks all signals in this thread while it lives. Until the new process has reset its handlers,
/// a signal sent to it would reach handlers it shares with this one.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_{};
};

/// Resets handled signals to their defaults and unblocks all, in the new process. Ignored signals
/// stay ignored, as nohup needs.
void forget_signals() {
  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
      sigaction(signal, &by_default, nullptr);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

struct Bound {
  __rlimit_resource_t what;
  double most;
};

/// Sets the resource limits of this process; exits if one cannot be set.
void set_bounds(std::span<const Bound> bounds) {
  for (const Bound& bound : bounds) {
    if (!std::isfinite(bound.most)) continue;
    const rlimit limit{static_cast<rlim_t>(bound.most), static_cast<rlim_t>(bound.most)};
    if (setrlimit(bound.what, &limit) != 0) _exit(127);
  }
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

std::string program_beside(const std::string& name) {
  std::error_code code;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", code);
  return (self.parent_path() / name).string();
}

Child::Child(const std::vector<std::string>& words, const ChildOptions& options)
    : deadline_(wall_seconds() + options.limit_s) {
  std::vector<std::string> arguments{"acinus"}, variables = environment();
  arguments.insert(arguments.end(), words.begin(), words.end());
  const std::vector<char*> argv = pointers(arguments), envp = pointers(variables);
  const int error_file = open_output(options.output);
  const int out_file = options.progress.empty() ? error_file : open_output(options.progress);
  const std::array bounds{Bound{RLIMIT_AS, options.most_memory},
                          Bound{RLIMIT_CPU, options.most_cpu_s},
                          Bound{RLIMIT_FSIZE, options.largest_file}};
  const pid_t parent = getpid();
  int failed = 0;
  {
    const SignalsHeld held;
    id_ = fork();
    if (id_ == 0) {  // only async-signal-safe calls from here on
      forget_signals();
      if (options.follows_parent) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != parent) _exit(127);  // it ended before that was known
      }
      set_bounds(bounds);
      dup2(out_file, STDOUT_FILENO);
      dup2(error_file, STDERR_FILENO);
      // Sockets of clients are none of its business.
      close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
      execve(options.program.c_str(), argv.data(), envp.data());
      _exit(127);
    }
    failed = id_ < 0 ? errno : 0;
  }
  close(error_file);
  if (out_file != error_file) close(out_file);
  check(failed == 0,
        fmt::format("cannot start another process: {}. Are there too many?", std::strerror(failed)),
        Exit::kFileError);
  // glibc 2.36 declares pidfd_open without C linkage.
  descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, id_, 0));
  if (descriptor_ >= 0) return;
  const int error = errno;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
  throw Error(fmt::format("cannot watch a child process: {}.", std::strerror(error)),
              Exit::kFileError);
}

void Child::send(int signal) const { kill(id_, signal); }

Child::Child(Child&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      deadline_(other.deadline_) {}

Child& Child::operator=(Child&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(deadline_, other.deadline_);
  return *this;
}

Child::~Child() {
  if (id_ < 0) return;
  kill(id_, SIGKILL);
  collect();
}

ChildEnd Child::collect() {
  ChildEnd end;
  int status = 0;
  rusage used{};
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
  end.timed_out = info.si_pid == 0;
  if (end.timed_out) kill(id_, SIGKILL);
  wait4(id_, &status, 0, &used);
  close(descriptor_);
  id_ = descriptor_ = -1;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  end.cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime);
  if (WIFEXITED(status)) end.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

std::optional<std::size_t> wait_for_any(const std::vector<const Child*>& children,
                                        double patience_s) {
  std::vector<pollfd> ends;
  const double give_up = wall_seconds() + patience_s;
  double deadline = give_up;
  for (const Child* child : children) {
    ends.push_back({child->descriptor(), POLLIN, 0});
    deadline = std::min(deadline, child->deadline());
  }
  for (;;) {
    constexpr double kLongestWait = 1e6;  // s: poll counts milliseconds in an int
    const double left = std::clamp(deadline - wall_seconds(), 0.0, kLongestWait);
    const int n = poll(ends.data(), ends.size(), static_cast<int>(std::ceil(1000 * left)));
    for (std::size_t k = 0; k < ends.size(); ++k)
      if ((n > 0 && ends[k].revents != 0) || wall_seconds() > children[k]->deadline()) return k;
    if (std::isfinite(patience_s) && (n < 0 || wall_seconds() >= give_up)) return std::nullopt;
  }
}

}  // namespace acinus::runs
