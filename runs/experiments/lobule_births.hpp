#pragma once
/// Divisions in a lobule by the layer they happen in.

#include "coupling/life/life.hpp"
#include "coupling/world/world.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Adds the divisions of a report to the births by layer. The daughters must be at their birth
/// places still.
void count_births_by_layer(const Scene& scene, const coupling::World& world,
                           const coupling::LifeReport& report, ObservedRun& observed);

}  // namespace acinus::runs
