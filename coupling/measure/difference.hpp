#pragma once
/// Differences between two results of the same cells.

#include <span>

#include "core/vec.hpp"

namespace acinus::coupling {

/// Root mean square of the differences over that of the reference. 0 for equal values; infinite or
/// NaN if the reference is 0 and values differ, or a value is not finite.
/// @pre as many values as reference values
double relative_error(std::span<const double> value, std::span<const double> reference);

/// Distances between corresponding points, um.
struct Distance {
  double max = 0, rms = 0;
};

/// Distances between corresponding points after the rigid motion (no reflection) that fits them to
/// the reference by least squares [Kabsch1976]. Rigid motion of a cluster does not count, since
/// nothing fixes it.
/// @pre as many points as reference points, all finite
Distance aligned_distance(std::span<const Vec3> point, std::span<const Vec3> reference);

}  // namespace acinus::coupling
