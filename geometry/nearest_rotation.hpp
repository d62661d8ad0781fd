#pragma once
/// Rotation nearest to a matrix.

#include "core/vec.hpp"

namespace acinus::geometry {

/// Rotation R with the largest trace of R^T m. For m = sum of a b^T it is the least-squares
/// rotation of the vectors b onto the vectors a [Kabsch1976].
Mat3 nearest_rotation(const Mat3& m);

}  // namespace acinus::geometry
