#pragma once
/// What the runs of a study are expected to cost: what others of the same variant did; else the
/// rough estimate times what the others with cells of the same model took of theirs.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

class ExpectedCosts {
 public:
  /// Looks at the runs that are done in the study's folder.
  ExpectedCosts(const StudyPlan& plan, const std::string& root);

  void add(const StudyRun& run, double cpu_s);  ///< one more that is done
  bool is_measured(const StudyRun& run) const { return measured_.contains(run.variant); }
  /// Whether any run that says something about this one is done.
  bool has_basis(const StudyRun& run) const {
    return is_measured(run) || ratio_.contains(run.scene.cells.model);
  }
  double cpu_s(const StudyRun& run) const;

 private:
  struct Sum {
    double value = 0;
    int n = 0;
    void add(double v);
    double mean() const { return value / n; }
  };
  std::map<std::size_t, Sum> measured_;  ///< by variant
  std::map<CellModel, Sum> ratio_;       ///< measured over estimated, by model
};

/// One that is running.
struct RunningCost {
  std::size_t run = 0;           ///< index into the plan's runs
  double wall_s = 0;             ///< so far
  std::optional<double> left_s;  ///< by its own estimate
};

/// Wall time until all these runs are done, s. Nothing while it would rest on rough estimates.
/// @param jobs  runs at once
std::optional<double> estimate_time_left(const StudyPlan& plan, const ExpectedCosts& costs,
                                         const std::vector<std::size_t>& waiting,
                                         const std::vector<RunningCost>& running, int jobs);

}  // namespace acinus::runs
