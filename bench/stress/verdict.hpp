#pragma once
/// Outcomes of the random scenes of the stress suite.

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bench/output/bench_table.hpp"
#include "bench/stress/random_scene.hpp"

namespace acinus::bench {

/// Outcome of a random scene by exit code, events and inspection.
enum class TrialOutcome {
  kClean,      ///< completed without findings
  kNamed,      ///< completed; all findings were reported as events
  kStopped,    ///< exit 3 with a cause and a readable checkpoint
  kTimeLimit,  ///< stopped at its wall-time limit without findings
  kRefused,    ///< exit 2: a fault of the generator
  kCrashed,
  kHung,
  kNotFinite,
  kUnnoticed,  ///< findings that the run did not report
};
const char* name_of(TrialOutcome outcome);

/// Outcome of one scene.
struct RunVerdict {
  std::uint64_t seed = 0;
  TrialOutcome outcome = TrialOutcome::kClean;
  std::string cause;
  int cells = 0;
  double cpu_s = 0;
  std::map<std::string, int> events;  ///< number of each event
};

/// File of the verdicts of one program on scenes of one kind, a line per scene, so that many scenes
/// can be judged in several sessions.
class VerdictFile {
 public:
  /// Opens the file and reads its verdicts.
  /// @param path     "" = none
  /// @param program  hash of the program; lines of other programs are ignored
  VerdictFile(const std::string& path, const std::string& program, const SceneKind& kind);
  /// Verdicts that the file held when it was opened, by seed.
  const std::map<std::uint64_t, RunVerdict>& before() const { return before_; }
  void add(const RunVerdict& verdict);

 private:
  std::string program_;
  SceneKind kind_;
  std::map<std::uint64_t, RunVerdict> before_;
  std::ofstream file_;
};

/// Table row with the counts of one family.
BenchRow row_of(Family family, bool life, const std::vector<RunVerdict>& all);

}  // namespace acinus::bench
