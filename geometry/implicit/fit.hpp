#pragma once
/// Triangles laid about the zero of a function.

#include <functional>

#include "geometry/implicit/zero_surface.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// um, negative inside.
using Distance = std::function<double(const Vec3&)>;

/// Moves nodes until the function is zero in the mean over the triangles about each: with nodes on
/// a curved surface all triangles are on its inner side, and the volume is too small. Of second
/// order in the edge before, of fourth after. Along the edges that nodes stand on, so that the
/// surface does not cross itself.
void fit(const Distance& distance, ZeroSurface& surface);

/// The same of any surface, along the normals of its nodes.
/// @param most  of the mean edge about a node: none moves farther
void fit(const Distance& distance, double most, geometry::Surface& surface);

}  // namespace acinus::geometry
