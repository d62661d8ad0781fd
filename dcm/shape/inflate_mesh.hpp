#pragma once
/// Mesh of a cell inflated inside a closed surface that is not star-shaped.

#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Nodes of a sphere mesh inflated inside a surface, from the largest ball inside. Nodes move
/// outward, by no more than the distance of the surface, and along the mesh to the middle of the
/// triangles around them, so that these stay alike while the mesh flows into every arm. Nodes that
/// have reached the surface stay on it: a balloon [McInerney1996] with the evenness of
/// dcm/shape/cast.hpp. Pure geometry. An arm too narrow for the mesh is left empty.
/// @param surface   closed, outward
/// @param rotation  initial rotation of the sphere mesh
/// @return          [n_node] um; may be of bad quality: to be checked
std::vector<Vec3> inflate_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                               const Mat3& rotation);

}  // namespace acinus::dcm
