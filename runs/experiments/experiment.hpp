#pragma once
/// What a scene measures over time, by the name in its `experiment` key.

#include <map>
#include <string>
#include <vector>

#include "coupling/world.hpp"
#include "runs/frame.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Named series, one number per written frame. Kept in checkpoints.
using Measures = std::map<std::string, std::vector<double>>;

/// Adds the numbers of one moment. Does nothing for experiment "free".
void sample_experiment(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                       Measures& measures);

/// Closing of a central lesion: time_d, cells, lesion_radius_um, lesion_area_relative.
/// The lesion radius is the mean over z layers one cell diameter high of the distance from the vein
/// axis to the closest cell centre [VanLiedekerke2020, footnote 11]; the relative area is
/// ((r - floor) / (r0 - floor))^2 with floor = vein radius + cell radius.
void sample_lobule(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                   Measures& measures);

/// A box cut in two halves across x, one of each model: time_s, pressure and density of each half.
/// Pressure is the mean contact pressure of the half's cells; density is their number per volume
/// between the walls on their side of the plane midway between the innermost layers of the two
/// models.
void sample_patch(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
                  Measures& measures);

}  // namespace acinus::runs
