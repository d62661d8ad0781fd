#pragma once
/// A cell's mesh blown up inside a closed surface that no point sees whole.

#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Starts as the largest ball inside the surface. Nodes go outward, no farther than the surface is
/// away, and along the mesh to the middle of the triangles around them, so that these stay alike
/// while the mesh flows into every arm; where they have come to the surface they stay on it: a
/// balloon [McInerney1996] with the evenness of dcm/shape/cast.hpp. Pure geometry. A thin arm,
/// narrower than the mesh is fine, is left empty.
/// @param surface   closed, outward
/// @param rotation  of the sphere mesh at the start
/// @return          [n_node] um; may be bad: to be checked
std::vector<Vec3> inflate_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                               const Mat3& rotation);

}  // namespace acinus::dcm
