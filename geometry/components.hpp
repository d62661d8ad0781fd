#pragma once
/// Connected parts of a triangle surface.

#include <array>
#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// [node] lowest node of the node's connected part; itself if it is in no triangle.
std::vector<int> find_parts(const Surface& surface);

/// Surface of the given triangles with only the nodes they use, in their order.
Surface compacted(const std::vector<Vec3>& node, std::vector<std::array<int, 3>> triangle);

/// Connected parts, sharing no node, ordered by their first triangle. Nodes keep their order; those
/// of no triangle are left out.
std::vector<Surface> split_components(const Surface& surface);

}  // namespace acinus::geometry
