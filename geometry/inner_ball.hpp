#pragma once
/// Deepest point of a body, for bodies placed inside that are to grow.

#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

struct InnerBall {
  Vec3 center = Vec3::Zero();
  double radius = 0;  ///< um; 0 if the surface encloses no volume
};

/// Largest ball inside a closed outward surface (its pole of inaccessibility): radius within 5 % of
/// the body's volume radius. Boxes too far outside to hold a deeper point are dropped, the others
/// cut in eight, the most promising first. Cost: about a hundred passes over the triangles.
InnerBall find_inner_ball(const Surface& surface);

}  // namespace acinus::geometry
