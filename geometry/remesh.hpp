#pragma once
/// Remeshing to triangles of one size. CGAL stays in the .cpp.

#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Closed surface with nearly equilateral triangles whose sides are near `edge`, um; its nodes lie
/// close to the given surface [Botsch2004]. It can cross itself where that has parts much nearer to
/// each other than an edge: see crosses_itself. @pre check_manifold
Surface remesh(const Surface& surface, double edge);

/// True if any two triangles meet elsewhere than at a common node or side.
bool crosses_itself(const Surface& surface);

/// Triangles that do so, ascending.
std::vector<int> find_crossing_triangles(const Surface& surface);

}  // namespace acinus::geometry
