#pragma once
/// The connected parts of a triangle surface.

#include <array>
#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// [node] the lowest node of the part that it is in; itself, if it is in no triangle.
std::vector<int> find_parts(const Surface& surface);

/// The given triangles with only the nodes they use, in their order.
Surface compacted(const std::vector<Vec3>& node, std::vector<std::array<int, 3>> triangle);

/// Parts that share no node, ordered by their first triangle; nodes keep their order, and those of
/// no triangle are left out.
std::vector<Surface> split_components(const Surface& surface);

}  // namespace acinus::geometry
