#pragma once
/// Expected cost of the runs of a study: measured on finished runs of the same variant, else
/// estimated a priori and scaled by finished runs of the same model.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Expected CPU time of every run of a study.
class ExpectedCosts {
 public:
  /// Takes the costs of the runs that are complete in the study's folder.
  ExpectedCosts(const StudyPlan& plan, const std::string& root);

  void add(const StudyRun& run, double cpu_s);  ///< enters a completed run; CPU time in s
  bool is_measured(const StudyRun& run) const { return measured_.contains(run.variant); }
  /// True if a completed run of the same variant or model calibrates the estimate for this one.
  bool has_basis(const StudyRun& run) const {
    return is_measured(run) || ratio_.contains(model_of(run.scene));
  }
  double cpu_s(const StudyRun& run) const;

 private:
  struct Sum {
    double value = 0;
    int n = 0;
    void add(double v);
    double mean() const { return value / n; }
  };
  std::map<std::size_t, Sum> measured_;  ///< CPU time of complete runs by variant, s
  std::map<CellModel, Sum> ratio_;       ///< measured over estimated CPU time, by model
};

/// Cost so far of a run in progress.
struct RunningCost {
  std::size_t run = 0;           ///< index into the plan's runs
  double wall_s = 0;             ///< wall time so far, s
  std::optional<double> left_s;  ///< own estimate of the remaining wall time, s
};

/// Estimated wall time until all these runs are complete, s. Empty while only a-priori estimates
/// exist.
/// @param waiting  indices of runs not yet started
/// @param jobs     concurrent runs
std::optional<double> estimate_time_left(const StudyPlan& plan, const ExpectedCosts& costs,
                                         const std::vector<std::size_t>& waiting,
                                         const std::vector<RunningCost>& running, int jobs);

}  // namespace acinus::runs
