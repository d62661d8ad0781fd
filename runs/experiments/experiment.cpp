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
  if (const auto sample = experiment_row(frame.scene.experiment).sample) sample(frame, observed);
}

}  // namespace acinus::runs
