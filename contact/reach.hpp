#pragma once
/// Convex region of the search for candidates.

#include "core/vec.hpp"

namespace acinus::contact {

/// Region in which parts of one body may be near another: within the other's box, and not behind it
/// along the axis between the two.
struct Reach {
  Vec3 middle, half;
  Vec3 axis = Vec3::Zero();  ///< away from the other body
  double limit = 1e300;      ///< of axis . x

  /// Bounds of the region that a point is beyond, a bit for each.
  unsigned outside(const Vec3& x) const {
    const Vec3 d = x - middle;
    unsigned bits = x.dot(axis) > limit ? 1 : 0;
    for (int m = 0; m < 3; ++m)
      bits = bits << 2 | unsigned{d[m] > half[m]} << 1 | unsigned{d[m] < -half[m]};
    return bits;
  }

  bool includes(const Vec3& center, double radius) const {
    const Vec3 outside = (center - middle).cwiseAbs() - half;
    // Branch-free, since the deciding condition of the four is unpredictable.
    const int inside = int{outside[0] <= radius} & int{outside[1] <= radius} &
                       int{outside[2] <= radius} & int{center.dot(axis) - limit <= radius};
    return inside != 0;
  }
};

}  // namespace acinus::contact
