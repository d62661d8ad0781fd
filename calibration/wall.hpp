#pragma once
/// How spheres stand at a rigid wall: deformable cells fill the room there, spheres that push as
/// hard in the bulk leave some of it free, so that their capsule would be wider.

#include "calibration/compression.hpp"

namespace acinus::calibration {

/// How much wider the capsule of the spheres is than that of the cells when their inner cells bear
/// the same force, um: mean over the snapshots of the cells that press, at an overlap up to
/// `highest`.
/// @param cells    a compression whose inner cells count
/// @param spheres  the same cells as spheres, by themselves
/// @return NaN where they never bear the same
double capsule_excess(const Compression& cells, const std::vector<ClumpSnapshot>& spheres,
                      double highest);

}  // namespace acinus::calibration
