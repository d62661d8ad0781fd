#pragma once
/// Ball cut by planes: its volume, and area and centroid of every cut face.

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

/// Position of the power plane of two balls (that of their circle of intersection) on the line of
/// centres: share of the distance from the first. The shares of the two add up to 1.
inline double share_to_power_plane(double radius, double other_radius, double distance) {
  return 0.5 * (1 + (radius * radius - other_radius * other_radius) / (distance * distance));
}

/// Cutting plane: points with x . normal > distance are cut off, x from the centre of the ball.
struct BallCut {
  Vec3 normal = Vec3::UnitZ();  ///< unit vector
  double distance = 0;          ///< um, negative if the centre itself is cut off
};

struct CutFace {
  double area = 0;             ///< um^2
  Vec3 middle = Vec3::Zero();  ///< um, its centroid, from the centre of the ball
};

struct CutBall {
  double volume = 0;          ///< um^3
  std::vector<CutFace> face;  ///< [plane]
};

/// Cuts a ball by planes, exactly up to rounding. No corners are stored: every face is computed by
/// itself from its straight and its round pieces. About n^3 operations for n planes. The volume is
/// that of cones over the faces and over the rest of the sphere (divergence theorem).
CutBall cut_ball(double radius, std::span<const BallCut> planes);

}  // namespace acinus::geometry
