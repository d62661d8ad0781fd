#pragma once
/// Triangulation of polygons.

#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

/// Largest number of corners of a polygon: the search for the best ear costs n^3.
inline constexpr std::size_t kMaxPolygon = 256;

/// Cuts one polygon, convex or not, slightly bent or not, into n - 2 triangles with its orientation
/// by ear clipping, the best shaped ear first. `corner` are indices into `node`, all different,
/// 3 to kMaxPolygon of them. A polygon that crosses itself still gives n - 2 triangles.
std::vector<std::array<int, 3>> triangulate(std::span<const int> corner,
                                            std::span<const Vec3> node);

}  // namespace acinus::geometry
