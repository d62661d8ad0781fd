#pragma once
/// How far two results of the same cells are apart.

#include <span>

#include "core/vec.hpp"

namespace acinus::coupling {

/// Root mean square of the differences over that of the reference. 0 where nothing differs,
/// infinite or NaN where the reference is zero and something does or a value is not finite.
/// @pre   as many values as reference values
double relative_error(std::span<const double> value, std::span<const double> reference);

/// Distances between points that belong together, um.
struct Distance {
  double max = 0, rms = 0;
};

/// Distances left after the rigid motion (no reflection) that brings the points closest to the
/// reference in the sense of least squares [Kabsch1976]. A cluster that has moved or turned as a
/// whole has not changed: nothing holds it in place.
/// @pre   as many points as reference points, all finite
Distance aligned_distance(std::span<const Vec3> point, std::span<const Vec3> reference);

}  // namespace acinus::coupling
