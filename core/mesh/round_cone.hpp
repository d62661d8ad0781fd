#pragma once
/// Distance to a round cone: two balls and all balls between them, whose radius runs linearly.

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::mesh {

/// The ball of the cone whose surface is nearest to a point, or that the point is deepest in.
struct NearestBall {
  double parameter = 0;       ///< 0..1, from the first end to the second
  double radius = 0;          ///< um
  Vec3 apart = Vec3::Zero();  ///< um, from its centre to the point
};

/// Exact, also where one end lies within the other: then that is the larger of the two.
inline NearestBall find_nearest_ball(const Vec3& x, const Vec3& a, const Vec3& b, double ra,
                                     double rb) {
  const Vec3 axis = b - a;
  const double length = axis.norm();
  double t = ra >= rb ? 0.0 : 1.0;
  if (length > std::abs(rb - ra)) {
    const Vec3 u = axis / length;
    const double along = (x - a).dot(u);
    const double across = ((x - a) - along * u).norm();
    const double slope = (rb - ra) / length;
    // The centre of the closest ball is shifted along the axis by the taper.
    t = std::clamp((along + across * slope / std::sqrt(1 - slope * slope)) / length, 0.0, 1.0);
  }
  return {t, ra + t * (rb - ra), x - (a + t * axis)};
}

}  // namespace acinus::mesh
