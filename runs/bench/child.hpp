#pragma once
/// This very program started again as a child process.

#include <sys/types.h>

#include <string>
#include <vector>

namespace acinus::runs {

struct ChildEnd {
  int code = -1;           ///< exit code; -1 when a signal ended it
  int signal = 0;          ///< the signal that did; 0 = none
  bool timed_out = false;  ///< it ran beyond its limit and was killed
  double cpu_s = 0;        ///< s, user and system
};

/// One running child. The destructor kills what still runs.
class Child {
 public:
  /// @param words    command line after the program's name
  /// @param output   file that gets stdout and stderr
  /// @param limit_s  wall time after which the child is killed
  /// @throws Error(kFileError) if it cannot be started
  Child(const std::vector<std::string>& words, const std::string& output, double limit_s);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();

  double deadline() const { return deadline_; }   ///< wall_seconds()
  int descriptor() const { return descriptor_; }  ///< readable when the child has ended
  /// Kills the child if it still runs, then collects it.
  ChildEnd collect();

 private:
  pid_t id_ = -1;
  int descriptor_ = -1;
  double deadline_ = 0;
};

/// Waits until a child has ended or is beyond its limit. @return its index
std::size_t wait_for_any(const std::vector<const Child*>& children);

}  // namespace acinus::runs
