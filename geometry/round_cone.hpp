#pragma once
/// Distance to a round cone: two balls and all balls between them, whose radius is linear.

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::geometry {

/// Ball of the cone whose surface is nearest to a point, or in which the point is deepest.
struct NearestBall {
  double parameter = 0;       ///< 0..1, from the first end to the second
  double radius = 0;          ///< um
  Vec3 apart = Vec3::Zero();  ///< um, from its centre to the point
};

/// Nearest ball of a round cone, exact also where one end lies within the other: the cone is then
/// the larger of the two.
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

/// Wall of a round cone, prepared for many distances.
class ConeWall {
 public:
  ConeWall(const Vec3& a, const Vec3& b, double ra, double rb)
      : start_(a), end_(b), start_radius_(ra), end_radius_(rb) {
    const Vec3 along = b - a;
    const double length = along.norm();
    if (length > std::abs(rb - ra)) {
      axis_ = along / length;
      taper_ = (rb - ra) / length;
      flank_ = std::sqrt(1 - taper_ * taper_);
      last_ = flank_ * length;
    } else if (ra < rb) {  // the larger end holds all
      start_ = b;
      start_radius_ = rb;
    } else {
      end_ = a;
      end_radius_ = ra;
    }
  }

  /// Signed distance, um, negative inside.
  double distance(const Vec3& x) const {
    const Vec3 apart = x - start_;
    const double along = apart.dot(axis_), across = (apart - along * axis_).norm();
    const double at = flank_ * along + taper_ * across;
    if (at >= last_) return (x - end_).norm() - end_radius_;
    if (at <= 0) return apart.norm() - start_radius_;
    return flank_ * across - taper_ * along - start_radius_;
  }

 private:
  Vec3 start_, end_, axis_ = Vec3::Zero();
  double start_radius_, end_radius_;
  double taper_ = 0, flank_ = 1;  ///< sine of the angle between axis and wall, and its cosine
  double last_ = 0;
};

}  // namespace acinus::geometry
