#pragma once
/// Fit of triangles to the zero of a function.

#include <functional>

#include "geometry/implicit/zero_surface.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Signed distance of a point, um, negative inside.
using Distance = std::function<double(const Vec3&)>;

/// Moves nodes until the function is zero in the mean over the triangles about each: with nodes on
/// a curved surface all triangles are on its inner side, and the volume is too small. The error of
/// the volume is of second order in the edge before, of fourth after. Nodes move along their
/// tetrahedron's edges, so that the surface does not cross itself.
void fit(const Distance& distance, ZeroSurface& surface);

/// Moves the nodes of any surface likewise, along their normals.
/// @param most  of the mean edge about a node: largest displacement
void fit(const Distance& distance, double most, geometry::Surface& surface);

}  // namespace acinus::geometry
