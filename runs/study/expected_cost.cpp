#include "runs/study/expected_cost.hpp"

#include <algorithm>

#include "runs/study/cost.hpp"
#include "runs/study/run_status.hpp"

namespace acinus::runs {

ExpectedCosts::ExpectedCosts(const StudyPlan& plan, const std::string& root) {
  for (const StudyRun& run : plan.runs) {
    const RunStatus status = inspect_run(root, run);
    if (status.state == RunState::kDone) add(run, status.cpu_s);
  }
}

void ExpectedCosts::Sum::add(double v) {
  value += v;
  ++n;
}

void ExpectedCosts::add(const StudyRun& run, double cpu_s) {
  measured_[run.variant].add(cpu_s);
  ratio_[model_of(run.scene)].add(cpu_s / estimate_cost(run.scene, run.source >= 0));
}

double ExpectedCosts::cpu_s(const StudyRun& run) const {
  const auto found = measured_.find(run.variant);
  if (found != measured_.end()) return found->second.mean();
  const auto ratio = ratio_.find(model_of(run.scene));
  return estimate_cost(run.scene, run.source >= 0) *
         (ratio == ratio_.end() ? 1 : ratio->second.mean());
}

std::optional<double> estimate_time_left(const StudyPlan& plan, const ExpectedCosts& costs,
                                         const std::vector<std::size_t>& waiting,
                                         const std::vector<RunningCost>& running, int jobs) {
  double left = 0, longest = 0;
  for (const std::size_t k : waiting) {
    if (!costs.has_basis(plan.runs[k])) return std::nullopt;
    left += costs.cpu_s(plan.runs[k]);
  }
  for (const RunningCost& r : running) {
    const StudyRun& run = plan.runs[r.run];
    if (!r.left_s && !costs.has_basis(run)) return std::nullopt;
    const double rest = r.left_s ? *r.left_s : std::max(0.0, costs.cpu_s(run) - r.wall_s);
    left += rest;
    longest = std::max(longest, rest);
  }
  return std::max(left / jobs, longest);
}

}  // namespace acinus::runs
