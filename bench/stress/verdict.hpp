#pragma once
/// How the random scenes of the stress suite ended.

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bench/output/bench_table.hpp"
#include "bench/stress/random_scene.hpp"

namespace acinus::bench {

enum class TrialOutcome {
  kClean,      ///< completed, nothing found
  kNamed,      ///< completed; what was found, the run told as an event
  kStopped,    ///< exit 3 with a cause and a checkpoint that opens
  kTimeLimit,  ///< stopped by its own wall-time limit, nothing found
  kRefused,    ///< exit 2: the generator's fault
  kCrashed,
  kHung,
  kNotFinite,
  kUnnoticed,  ///< the run found nothing wrong, the inspection did
};
const char* name_of(TrialOutcome outcome);

/// What came of one scene.
struct RunVerdict {
  std::uint64_t seed = 0;
  TrialOutcome outcome = TrialOutcome::kClean;
  std::string cause;
  int cells = 0;
  double cpu_s = 0;
  std::map<std::string, int> events;  ///< how often each was told
};

/// The verdicts of one program on scenes of one kind, in a file that grows by a line per scene, so
/// that many scenes can be judged in several sittings.
class VerdictFile {
 public:
  /// @param path     "": none
  /// @param program  whose verdicts these are; lines of others are passed over
  VerdictFile(const std::string& path, const std::string& program, bool life);
  /// Those that stood there.
  const std::map<std::uint64_t, RunVerdict>& before() const { return before_; }
  void add(const RunVerdict& verdict);

 private:
  std::string program_;
  bool life_;
  std::map<std::uint64_t, RunVerdict> before_;
  std::ofstream file_;
};

/// The counts of one family.
BenchRow row_of(Family family, bool life, const std::vector<RunVerdict>& all);

}  // namespace acinus::bench
