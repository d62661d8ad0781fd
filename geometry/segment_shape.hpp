#pragma once
/// Segments of a network as round cones.

#include <limits>

#include "core/box.hpp"
#include "geometry/network.hpp"
#include "geometry/round_cone.hpp"

namespace acinus::geometry {

inline NearestBall nearest_ball(const Network& n, int segment, const Vec3& x) {
  const std::size_t s = segment;
  const auto& [a, b] = n.segment[s];
  const auto& [ra, rb] = n.radius[s];
  return find_nearest_ball(x, n.node[a], n.node[b], ra, rb);
}

/// Segment whose wall is nearest to a place, or in which the place is deepest.
struct NearestSegment {
  int segment = -1;                                      ///< -1: none
  double gap = std::numeric_limits<double>::infinity();  ///< um, negative inside
};
inline NearestSegment nearest_segment(const Network& n, const Vec3& x) {
  NearestSegment nearest;
  for (int s = 0; s < static_cast<int>(n.segment.size()); ++s) {
    const NearestBall ball = nearest_ball(n, s, x);
    const double gap = ball.apart.norm() - ball.radius;
    if (gap < nearest.gap) nearest = {s, gap};
  }
  return nearest;
}

inline bool share_a_node(const Network& n, int s, int t) {
  const auto& [a, b] = n.segment[s];
  const auto& [c, d] = n.segment[t];
  return a == c || a == d || b == c || b == d;
}

/// Bounding box of a segment. @param wider  factor on the radii
inline Box cone_box(const Network& n, std::size_t segment, double wider = 1) {
  Box box;
  for (const std::size_t end : {0, 1}) {
    const Box ball = sphere_box(n.node[n.segment[segment][end]], wider * n.radius[segment][end]);
    box.include(ball.low);
    box.include(ball.high);
  }
  return box;
}

}  // namespace acinus::geometry
