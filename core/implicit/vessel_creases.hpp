#pragma once
/// Narrow gaps between vessels that leave one node.

#include <vector>

#include "core/implicit/extract.hpp"
#include "core/mesh/network.hpp"

namespace acinus::implicit {

/// Where the walls of two segments that share a node face each other, with a gap between them that
/// larger tetrahedra would reach across: on the thinner of the two. The gap begins where the
/// rounding of the crease ends, wider than the smallest tetrahedra asked for are long.
/// @param rounding   VesselField
/// @param of_radius  longest edge of the tetrahedra elsewhere over the radius
std::vector<FineBall> find_sharp_creases(const mesh::Network& network, double rounding,
                                         double of_radius);

}  // namespace acinus::implicit
