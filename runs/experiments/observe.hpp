#pragma once
/// Measurements of a run, frame by frame and birth by birth.

#include <string>
#include <vector>

#include "coupling/life/life.hpp"
#include "coupling/world/world.hpp"
#include "io/frame.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/experiments/observed_frame.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// True if observables of a scene read the points of all cells, which every process must have then.
bool reads_points(const Scene& scene, const coupling::World& world);

/// Measures a frame of the run phase: adds to all series and returns the row of /observables, time
/// first. A series without a value at this frame is 0 there.
std::vector<io::SeriesValue> observe_frame(const ObservedFrame& frame, ObservedRun& observed);

/// Reason why the run may end: the series show all that the experiment is about, as when cells that
/// are pulled apart have come apart. Empty: none.
std::string why_over(Experiment experiment, const Measures& measures);

/// True if the experiment counts divisions, for which every process must have the points of all
/// cells.
bool counts_births(const Scene& scene);
/// Counts divisions if the experiment does. To be called while the daughters are where they were
/// born.
void observe_births(const Scene& scene, const coupling::World& world,
                    const coupling::LifeReport& report, ObservedRun& observed);

}  // namespace acinus::runs
