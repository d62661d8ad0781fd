#pragma once
/// The walls of vessels as one closed surface, which cells touch in place of the cones that it is
/// laid around: without the creases where these meet.

#include <cstddef>
#include <vector>

#include "contact/static_mesh.hpp"
#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::contact {

struct WallMesh {
  StaticMesh surface;
  std::vector<int> segment;  ///< [triangle] the segment that it is a wall of: the nearest
  /// Triangles of each segment, from first_of_segment[segment] on. None where it is buried in
  /// others.
  std::vector<int> of_segment;
  std::vector<std::size_t> first_of_segment;
};

/// @param surface  closed, outward, about the network
WallMesh make_wall_mesh(const geometry::Network& network, geometry::Surface surface);

}  // namespace acinus::contact
