#pragma once
/// What the runs of a study are expected to cost: what others of the same variant did; else the
/// rough estimate times what the others with cells of the same model took of theirs.

#include <map>
#include <string>

#include "runs/study/plan.hpp"

namespace acinus::runs {

class ExpectedCosts {
 public:
  /// Looks at the runs that are done in the study's folder.
  ExpectedCosts(const StudyPlan& plan, const std::string& root);

  void add(const StudyRun& run, double cpu_s);  ///< one more that is done
  bool is_measured(const StudyRun& run) const { return measured_.contains(run.variant); }
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

}  // namespace acinus::runs
