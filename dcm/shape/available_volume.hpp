#pragma once
/// Volume available to a cell between its neighbours, and a mesh that fills it. Pure geometry.

#include <functional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Flat face of an available volume.
struct VolumeFace {
  Vec3 normal;          ///< outward, of length 1
  double distance = 0;  ///< um from the centre of the cell, positive
};

/// Position of the face between two balls, as a share of the distance of their centres: the plane
/// of the circle in which they intersect (their power plane), but at least a quarter of the
/// distance from either centre, so that both keep some volume. The shares of the two add up to 1.
double share_of_distance(double radius, double other_radius, double distance);

/// Distance from the centre to the nearest face in a direction, um; at most `farthest`.
/// @param direction  of length 1
double reach_to_faces(const Vec3& direction, double farthest, std::span<const VolumeFace> face);

/// Ball that cuts an available volume.
struct CuttingBall {
  double radius = 0;           ///< um
  Vec3 offset = Vec3::Zero();  ///< um, of its centre from that of the volume; less than the radius
};

/// Available volume, star-shaped from its centre.
class AvailableVolume {
 public:
  /// Distance from the centre to the surface in a direction of length 1, um; positive.
  using Reach = std::function<double(const Vec3& direction)>;
  AvailableVolume(const Vec3& center, Reach reach);

  /// Size of the part within a ball, um^3.
  double volume(const CuttingBall& ball) const;

  /// Radius of the ball in which the part has this volume, um; `largest` if that is too small.
  double find_radius(double volume, double largest, const Vec3& offset = Vec3::Zero()) const;

  /// Ball in which the part has this volume and its centroid at the centre, or near it if
  /// faces bound most of the part. Faces keep their places; the free surface moves.
  /// @param largest  um, largest radius
  CuttingBall find_ball(double volume, double largest) const;

  /// Nodes of a mesh spread over the surface of the part within a ball, um.
  /// @param direction  [n_node] of length 1, to the nodes of the whole ball
  /// @return           [n_node] um
  std::vector<Vec3> fill(const geometry::Topology& topology, std::span<const Vec3> direction,
                         const CuttingBall& ball) const;

 private:
  std::vector<Vec3> show(const CuttingBall& ball) const;
  Mat3 centroid_by_offset(const CuttingBall& ball) const;

  Vec3 center_;
  Reach reach_;
  std::vector<double> shown_;  ///< um, reach along the nodes of a fine sphere
};

}  // namespace acinus::dcm
