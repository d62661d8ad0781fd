#include "runs/study/expected_cost.hpp"

#include "runs/study/cost.hpp"
#include "runs/study/run_status.hpp"

namespace acinus::runs {

ExpectedCosts::ExpectedCosts(const StudyPlan& plan, const std::string& root) {
  for (const StudyRun& run : plan.runs) {
    const RunStatus status = inspect_run(root, run);
    if (status.state == RunState::kDone) add(run, status.cpu_s);
  }
}

void ExpectedCosts::add(const StudyRun& run, double cpu_s) {
  Sum& sum = measured_[run.variant];
  sum.cpu_s += cpu_s;
  ++sum.n;
}

double ExpectedCosts::cpu_s(const StudyRun& run) const {
  const auto found = measured_.find(run.variant);
  if (found != measured_.end()) return found->second.cpu_s / found->second.n;
  return estimate_cost(run.scene, run.source >= 0);
}

}  // namespace acinus::runs
