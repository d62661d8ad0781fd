#include "runs/bench/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/timing.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kThreads = "OMP_NUM_THREADS";

/// This process's environment with one thread for the child.
std::vector<std::string> environment() {
  std::vector<std::string> all{std::string(kThreads) + "=1"};
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (std::strncmp(*entry, kThreads, std::strlen(kThreads)) != 0) all.emplace_back(*entry);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

Child::Child(const std::vector<std::string>& words, const std::string& output, double limit_s)
    : deadline_(wall_seconds() + limit_s) {
  std::vector<std::string> arguments{"acinus"}, variables = environment();
  arguments.insert(arguments.end(), words.begin(), words.end());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  const int failed = posix_spawn(&id_, "/proc/self/exe", &actions, nullptr,
                                 pointers(arguments).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  check(failed == 0,
        fmt::format("cannot start another process: {}. Is {} writable, and are there too many "
                    "processes?",
                    std::strerror(failed), output),
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

std::size_t wait_for_any(const std::vector<const Child*>& children) {
  std::vector<pollfd> ends;
  double deadline = std::numeric_limits<double>::infinity();
  for (const Child* child : children) {
    ends.push_back({child->descriptor(), POLLIN, 0});
    deadline = std::min(deadline, child->deadline());
  }
  for (;;) {
    const double left = deadline - wall_seconds();
    poll(ends.data(), ends.size(), std::max(0, static_cast<int>(std::ceil(1000 * left))));
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (ends[k].revents != 0 || wall_seconds() > children[k]->deadline()) return k;
  }
}

}  // namespace acinus::runs
