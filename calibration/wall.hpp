#pragma once
/// Recess of spheres at a rigid wall: deformable cells fill the volume there, spheres that exert
/// the same force in the bulk leave some of it empty, so that their capsule would be wider.

#include "calibration/compression.hpp"

namespace acinus::calibration {

/// Excess of the spheres' capsule radius over that of the cells when their inner cells carry the
/// same force, um: mean over the loaded snapshots of the cells, at an overlap up to `highest`.
/// @param cells    a compression whose inner cells count
/// @param spheres  the same cells as spheres, by themselves
/// @return NaN where they never carry the same
double capsule_excess(const Compression& cells, const std::vector<ClumpSnapshot>& spheres,
                      double highest);

}  // namespace acinus::calibration
