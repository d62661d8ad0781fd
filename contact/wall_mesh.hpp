#pragma once
/// Closed surface about the vessels, which cells touch in place of the cones of the segments. It
/// lacks the creases at the joints of the cones.

#include <cstddef>
#include <vector>

#include "contact/static_mesh.hpp"
#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::contact {

struct WallMesh {
  StaticMesh surface;
  std::vector<int> segment;  ///< [triangle] nearest segment
  /// Triangles of each segment, from first_of_segment[segment] on; none for a segment that is
  /// buried in others.
  std::vector<int> of_segment;
  std::vector<std::size_t> first_of_segment;
};

/// Closed surface about a network, with the segment of each triangle.
/// @param surface  closed, outward, about the network
WallMesh make_wall_mesh(const geometry::Network& network, geometry::Surface surface);

}  // namespace acinus::contact
