#include "runs/experiments/experiment.hpp"

namespace acinus::runs {

const ExperimentRow free_experiment{.meaning = "only what every scene measures"};

}  // namespace acinus::runs
