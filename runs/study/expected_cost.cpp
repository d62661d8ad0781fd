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

void ExpectedCosts::Sum::add(double v) {
  value += v;
  ++n;
}

void ExpectedCosts::add(const StudyRun& run, double cpu_s) {
  measured_[run.variant].add(cpu_s);
  ratio_[run.scene.cells.model].add(cpu_s / estimate_cost(run.scene, run.source >= 0));
}

double ExpectedCosts::cpu_s(const StudyRun& run) const {
  const auto found = measured_.find(run.variant);
  if (found != measured_.end()) return found->second.mean();
  const auto ratio = ratio_.find(run.scene.cells.model);
  return estimate_cost(run.scene, run.source >= 0) *
         (ratio == ratio_.end() ? 1 : ratio->second.mean());
}

}  // namespace acinus::runs
