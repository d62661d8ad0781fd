#pragma once
/// Vessels as a function of space: negative inside the union of their round cones.

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/implicit/vessel_pieces.hpp"
#include "geometry/network.hpp"
#include "geometry/round_cone.hpp"

namespace acinus::geometry {

/// Radius of the ball that rolls along the crease between two walls, um. It never enters where the
/// gap between them is narrower: so a gap begins with a width that triangles can resolve.
double crease_radius(double rounding, const geometry::NearestBall& a,
                     const geometry::NearestBall& b);

/// Signed distance of the union of all vessels, with the crease rounded where two of them share a
/// node. Vessels that only pass each other are never joined by rounding. Outside and near the
/// surface it is the distance, in a crease that to the rounded surface.
class VesselField {
 public:
  /// Keeps references to vessels and pieces.
  /// @param rounding  radius of creases over the smaller radius of the two vessels there
  VesselField(const geometry::Network& vessels, const VesselPieces& pieces, double rounding);

  /// Value at a place where only some pieces matter, um.
  double value(const Vec3& x, std::span<const int> pieces) const;

  /// Distance to one piece, um.
  double distance(const Vec3& x, int piece) const;

  /// Largest distance to both walls of a crease of this piece, um, at which its rounding acts.
  double crease_reach(int piece) const;

 private:
  const geometry::Network& vessels_;
  const VesselPieces& pieces_;
  std::vector<geometry::ConeWall> cone_;  ///< [piece]
  double rounding_ = 0, widest_ = 0;
};

}  // namespace acinus::geometry
