#include "runs/experiments/experiment.hpp"

namespace acinus::runs {

void sample_experiment(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                       Measures& measures) {
  measures["time_s"].push_back(snapshot.time);
  measures["cells"].push_back(static_cast<double>(snapshot.cells.size()));
  if (scene.experiment == Experiment::kPatch) sample_patch(scene, world, snapshot, measures);
  if (scene.experiment == Experiment::kCapsule) sample_capsule(scene, world, snapshot, measures);
  if (scene.experiment == Experiment::kRelaxation)
    sample_relaxation(scene, world, snapshot, measures);
  if (scene.experiment == Experiment::kSpheroid || scene.experiment == Experiment::kMonolayer)
    sample_growth(scene, world, snapshot, measures);
  if (scene.experiment == Experiment::kOpticalStretcher)
    sample_stretcher(scene, world, snapshot, measures);
}

}  // namespace acinus::runs
