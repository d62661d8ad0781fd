#pragma once
/// How spheres stand at a rigid wall: deformable cells fill the room there, spheres that push as
/// hard in the bulk leave some of it free, so that their capsule would be wider.

#include "calibration/clump.hpp"

namespace acinus::calibration {

/// How much wider the capsule of the spheres is than that of the cells when their inner cells bear
/// the same force, um: mean over the moments of the cells that press, at an overlap up to
/// `highest`.
/// @param cells    a squeeze whose inner cells count
/// @param spheres  the same cells as spheres, by themselves
/// @return NaN where they never bear the same
double capsule_excess(const Squeeze& cells, const std::vector<Moment>& spheres, double highest);

}  // namespace acinus::calibration
