#pragma once
/// Progress of a study: one line renewed on a terminal, one line a minute otherwise.

#include <cstddef>
#include <string>
#include <vector>

#include "runs/study/active_run.hpp"
#include "runs/study/expected_cost.hpp"

namespace acinus::runs {

/// Numbers of runs by state.
struct StudyCounts {
  int all = 0, done = 0, failed = 0;
  std::vector<std::size_t> waiting;  ///< indices of runs
};

/// Printer of the progress of a study, with the estimated time left.
class StudyProgress {
 public:
  StudyProgress(const StudyPlan& plan, const std::string& root, int jobs, bool quiet);

  void add(const StudyRun& run, double cpu_s) { costs_.add(run, cpu_s); }
  void show(const StudyCounts& counts, const std::vector<ActiveRun>& active);
  void note(const std::string& text);  ///< prints a permanent line
  void finish();

 private:
  const StudyPlan& plan_;
  ExpectedCosts costs_;
  int jobs_;
  bool quiet_, terminal_, line_open_ = false;
  double last_ = -1e300;  ///< time of the last line, wall_seconds()
};

/// Duration with a suitable unit: "40 s", "12.5 min", "3.2 h", "2.5 d".
std::string short_duration(double seconds);

}  // namespace acinus::runs
