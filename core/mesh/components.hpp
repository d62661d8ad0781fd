#pragma once
/// The connected parts of a triangle surface.

#include <vector>

#include "core/mesh/surface.hpp"

namespace acinus::mesh {

/// [node] the lowest node of the part that it is in; itself, if it is in no triangle.
std::vector<int> find_parts(const Surface& surface);

/// Parts that share no node, ordered by their first triangle; nodes keep their order, and those of
/// no triangle are left out.
std::vector<Surface> split_components(const Surface& surface);

}  // namespace acinus::mesh
