#pragma once
/// Triangles of one size. CGAL stays in the .cpp.

#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// A closed surface with triangles whose sides are near `edge`, um, and that are nearly
/// equilateral; its nodes lie close to the surface given [Botsch2004]. It can cross itself where
/// that has parts much nearer to each other than an edge: see crosses_itself. @pre check_manifold
Surface remesh(const Surface& surface, double edge);

/// Whether any two triangles meet elsewhere than at a common node or side.
bool crosses_itself(const Surface& surface);

/// The triangles that do, ascending.
std::vector<int> find_crossing_triangles(const Surface& surface);

}  // namespace acinus::geometry
