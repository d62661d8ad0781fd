#include "runs/experiments/experiment.hpp"

namespace acinus::runs {

const ExperimentRow free_experiment{.meaning = "only what every scene measures",
                                    .reads_snapshot_only = true};

}  // namespace acinus::runs
