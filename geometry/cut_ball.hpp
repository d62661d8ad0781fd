#pragma once
/// A ball of which planes cut parts off: its volume, and area and middle of every cut face.

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

/// Where the power plane of two balls, that of the circle in which they meet, crosses the line of
/// their middles: share of the distance from the first. The shares of the two add up to 1.
inline double share_to_power_plane(double radius, double other_radius, double distance) {
  return 0.5 * (1 + (radius * radius - other_radius * other_radius) / (distance * distance));
}

/// What stands behind it is cut off: x . normal > distance, x from the middle of the ball.
struct BallCut {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double distance = 0;          ///< um, negative if the middle itself is cut off
};

struct CutFace {
  double area = 0;             ///< um^2
  Vec3 middle = Vec3::Zero();  ///< um, its centroid, from the middle of the ball
};

struct CutBall {
  double volume = 0;          ///< um^3
  std::vector<CutFace> face;  ///< [plane]
};

/// Exact up to rounding, whatever the planes: no corners are stored, every face is worked out by
/// itself from its straight and its round pieces. About n^3 operations for n planes. The volume is
/// that of cones over the faces and over what is left of the sphere (divergence theorem).
CutBall cut_ball(double radius, std::span<const BallCut> planes);

}  // namespace acinus::geometry
