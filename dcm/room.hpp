#pragma once
/// The room that a cell has where others stand near it, and a mesh that fills it. Pure geometry.

#include <span>
#include <vector>

#include "core/mesh/topology.hpp"
#include "core/vec.hpp"

namespace acinus::dcm {

/// A flat face of the room.
struct RoomFace {
  Vec3 normal;          ///< outward, of length 1
  double distance = 0;  ///< um from the centre of the cell, positive
};

/// Where the face between two balls lies, as a share of the distance of their centres: in the plane
/// of the circle in which they meet (their power plane), but no nearer to a centre than a quarter
/// of the distance, so that both keep room. The shares of the two add up to 1.
double share_of_distance(double radius, double other_radius, double distance);

/// How far a ball cut by faces reaches from its centre, um.   @param direction  of length 1
double reach_of_room(const Vec3& direction, double radius, std::span<const RoomFace> face);

/// The nodes of a mesh spread over the surface of a ball cut by faces.
/// @param direction  [n_node] of length 1, where the nodes of the whole ball stand
/// @param radius     um, of the nodes of the whole ball
/// @return           [n_node] um; all within the faces
std::vector<Vec3> fill_room(const mesh::Topology& topology, std::span<const Vec3> direction,
                            const Vec3& center, double radius, std::span<const RoomFace> face);

}  // namespace acinus::dcm
