#pragma once
/// This program, or one that stands beside it, started as a child process.

#include <sys/types.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace acinus::runs {

struct ChildEnd {
  int code = -1;           ///< exit code; -1 when a signal ended it
  int signal = 0;          ///< the signal that did; 0 = none
  bool timed_out = false;  ///< it ran beyond its limit and was killed
  double cpu_s = 0;        ///< s, user and system
};

struct ChildOptions {
  /// The file to start. This very program unless told otherwise, also when a build has replaced its
  /// file meanwhile.
  std::string program = "/proc/self/exe";
  std::string output;         ///< file that gets stderr and, without `progress`, stdout
  std::string progress = "";  ///< file that gets stdout
  double limit_s = std::numeric_limits<double>::infinity();  ///< wall time, then it is killed
  /// Asked to stop by SIGTERM when this process ends, however it ends.
  bool follows_parent = false;
  /// Bounds of what it may take: address space and processor time, and the largest file it may
  /// write. Infinite: those of this process.
  double most_memory = std::numeric_limits<double>::infinity();   ///< bytes
  double most_cpu_s = std::numeric_limits<double>::infinity();    ///< s
  double largest_file = std::numeric_limits<double>::infinity();  ///< bytes
};

/// The path of a program in the folder of this one.
std::string program_beside(const std::string& name);

/// One running child. The destructor kills what still runs.
class Child {
 public:
  /// @param words  command line after the program's name
  /// @throws Error(kFileError) if it cannot be started
  Child(const std::vector<std::string>& words, const ChildOptions& options);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();

  void send(int signal) const;
  double deadline() const { return deadline_; }   ///< wall_seconds()
  int descriptor() const { return descriptor_; }  ///< readable when the child has ended
  /// Kills the child if it still runs, then collects it.
  ChildEnd collect();

 private:
  pid_t id_ = -1;
  int descriptor_ = -1;
  double deadline_ = 0;
};

/// Waits until a child has ended or is beyond its limit, at most `patience_s`.
/// @return its index; nothing when patience ends, or a signal came while it is not endless
std::optional<std::size_t> wait_for_any(
    const std::vector<const Child*>& children,
    double patience_s = std::numeric_limits<double>::infinity());

}  // namespace acinus::runs
