#pragma once
/// Wall and CPU time of stages.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace acinus {

/// Times of one named stage, including those of stages nested in it.
struct StageTime {
  std::string name;
  double wall = 0.0;  ///< s
  double cpu = 0.0;   ///< s, all threads of the process
  std::uint64_t calls = 0;
};

/// Accumulated stage times in order of first use. Not thread safe: scopes are opened outside
/// parallel regions. A scope costs about a microsecond and allocates only for a new name.
class Timings {
 public:
  /// Measurement of one stage from construction to destruction. The Timings must outlive it.
  class Scope {
   public:
    Scope(Timings& timings, std::string_view stage);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timings& timings_;
    std::size_t stage_;
    double wall_, cpu_;
  };

  [[nodiscard]] Scope scope(std::string_view stage) { return Scope(*this, stage); }

  const std::vector<StageTime>& stages() const { return stages_; }

  /// Times of the stage of this name; all zero if it never ran.
  StageTime stage(std::string_view name) const;

  void clear() { stages_.clear(); }

 private:
  std::size_t find_or_add(std::string_view name);
  std::vector<StageTime> stages_;
};

}  // namespace acinus
