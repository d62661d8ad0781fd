#pragma once
/// The room that a cell has where others stand near it, and a mesh that fills it. Pure geometry.

#include <functional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// A flat face of a room.
struct RoomFace {
  Vec3 normal;          ///< outward, of length 1
  double distance = 0;  ///< um from the centre of the cell, positive
};

/// Where the face between two balls lies, as a share of the distance of their centres: in the plane
/// of the circle in which they meet (their power plane), but no nearer to a centre than a quarter
/// of the distance, so that both keep room. The shares of the two add up to 1.
double share_of_distance(double radius, double other_radius, double distance);

/// How far one gets from the centre before a face, um; at most `farthest`.
/// @param direction  of length 1
double reach_to_faces(const Vec3& direction, double farthest, std::span<const RoomFace> face);

/// A room that is seen whole from its centre.
class Room {
 public:
  /// How far the room reaches in a direction of length 1, um; positive.
  using Reach = std::function<double(const Vec3& direction)>;
  Room(const Vec3& center, Reach reach);

  /// Of the room within a ball, um^3.
  double volume(double radius) const;

  /// Radius of the ball within which the room has this volume, um; `largest` if that is too small.
  double find_radius(double volume, double largest) const;

  /// The nodes of a mesh spread over the surface of the room within a ball.
  /// @param direction  [n_node] of length 1, where the nodes of the whole ball stand
  /// @return           [n_node] um
  std::vector<Vec3> fill(const geometry::Topology& topology, std::span<const Vec3> direction,
                         double radius) const;

 private:
  std::vector<Vec3> show(double radius) const;

  Vec3 center_;
  Reach reach_;
  std::vector<double> shown_;  ///< reach along the nodes of a fine sphere
};

}  // namespace acinus::dcm
