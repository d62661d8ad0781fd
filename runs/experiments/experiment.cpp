#include "runs/experiments/experiment.hpp"

#include <array>

namespace acinus::runs {
namespace {

#define ACINUS_ROW(constant, name) &name##_experiment,
constexpr std::array kRows{ACINUS_EXPERIMENTS(ACINUS_ROW)};
#undef ACINUS_ROW

}  // namespace

const ExperimentRow& experiment_row(Experiment experiment) {
  return *kRows.at(static_cast<std::size_t>(experiment));
}

void sample_experiment(const ObservedFrame& frame, ObservedRun& observed) {
  observed.measures["time_s"].push_back(frame.snapshot.time);
  observed.measures["cells"].push_back(static_cast<double>(frame.snapshot.cells.size()));
  const ExperimentRow& row = experiment_row(frame.scene.experiment);
  if (!observed.sampler)
    observed.sampler = row.make_sampler ? row.make_sampler(frame.world) : Sampler(row.sample);
  if (observed.sampler) observed.sampler(frame, observed);
}

}  // namespace acinus::runs
