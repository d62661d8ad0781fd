#include "runs/study/cost.hpp"

#include <algorithm>

#include "runs/assemble/place_cells.hpp"

namespace acinus::runs {
namespace {

/// CPU time per sphere and step in packed tissue, s (docs/developers/benchmarks.md).
constexpr double kSphereStepCost = 4e-6;
/// Mean number of solves per step with step-size control, since contacts close within the step.
constexpr double kSolvesPerStep = 3;
double cell_step(const Scene& scene, int nodes) {
  const double at_162 =
      scene.contact.quadrature == contact::Quadrature::kThreePoint ? 4e-4 : 2.5e-4;
  return at_162 * nodes / 162 * (scene.numerics.adaptive ? kSolvesPerStep : 1);
}

double count_final_cells(const Scene& scene) {
  if (scene.life.proliferation && scene.life.proliferation->cells > 0)
    return scene.life.proliferation->cells;
  return count_wanted_cells(scene);
}

/// Expected share of deformable cells: half for zoomed scenes, whose regions are not evaluated.
double share_deformable(const Scene& scene) {
  if (model_of(scene) == CellModel::kZoom) return scene.zoom.empty() ? 0 : 0.5;
  return model_of(scene) == CellModel::kDcm ? 1 : 0;
}

}  // namespace

double estimate_cost(const Scene& scene, bool shared_start) {
  int nodes = 162;
  for (const auto& [name, type] : scene.cell_types) nodes = type.dcm.nodes;
  double time = scene.time.end;
  if (scene.start_up.enabled && !shared_start)
    time += scene.start_up.growth_time + scene.start_up.adhesion_ramp + scene.start_up.max_settle;
  const double deformable = share_deformable(scene);
  const double one = deformable * cell_step(scene, nodes) + (1 - deformable) * kSphereStepCost;
  return std::max(0.1, time / scene.numerics.max_step * count_final_cells(scene) * one);
}

}  // namespace acinus::runs
