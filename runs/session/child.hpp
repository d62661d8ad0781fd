#pragma once
/// Child processes: this program, or one in its folder.

#include <sys/types.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace acinus::runs {

/// End of a child process.
struct ChildEnd {
  int code = -1;           ///< exit code; -1 if a signal ended it
  int signal = 0;          ///< signal that ended it; 0 = none
  bool timed_out = false;  ///< killed after its wall-time limit
  double cpu_s = 0;        ///< CPU time, user and system, s
};

/// Program, output and limits of a child process.
struct ChildOptions {
  /// Executable file. By default this very program, even if its file was replaced meanwhile.
  std::string program = "/proc/self/exe";
  std::string output;         ///< file for stderr and, without `progress`, stdout
  std::string progress = "";  ///< file for stdout
  /// Wall-time limit, s; the child is killed after it.
  double limit_s = std::numeric_limits<double>::infinity();
  /// Send SIGTERM to the child when this process ends in any way.
  bool follows_parent = false;
  /// Resource limits; infinite: those of this process.
  double most_memory = std::numeric_limits<double>::infinity();  ///< address space, bytes
  double most_cpu_s = std::numeric_limits<double>::infinity();   ///< processor time, s
  /// Largest file it may write, bytes.
  double largest_file = std::numeric_limits<double>::infinity();
};

/// Path of a program in the folder of this one.
std::string program_beside(const std::string& name);

/// Child process. The destructor kills it if it still runs.
class Child {
 public:
  /// Starts the child.
  /// @param words  command line after the program's name
  /// @throws Error(kFileError) if it cannot be started
  Child(const std::vector<std::string>& words, const ChildOptions& options);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();

  void send(int signal) const;
  double deadline() const { return deadline_; }   ///< on the clock of wall_seconds()
  int descriptor() const { return descriptor_; }  ///< readable once the child has ended
  /// Kills the child if it still runs and reaps it.
  ChildEnd collect();

 private:
  pid_t id_ = -1;
  int descriptor_ = -1;
  double deadline_ = 0;
};

/// Waits until a child has ended or exceeded its time limit, at most patience_s (s).
/// @return its index; empty on timeout, or after a signal unless patience_s is infinite
std::optional<std::size_t> wait_for_any(
    const std::vector<const Child*>& children,
    double patience_s = std::numeric_limits<double>::infinity());

}  // namespace acinus::runs
