#pragma once
/// Gap of a point to surfaces of triangles and to segments of a network.

#include <span>

#include "contact/surface.hpp"
#include "core/vec.hpp"
#include "geometry/network.hpp"

namespace acinus::contact {

/// Gap of a point to an obstacle.
struct Gap {
  double gap = 0;               ///< um, negative inside the obstacle
  Vec3 normal = Vec3::UnitZ();  ///< d gap / d x, unit
  double axis_distance = 0;     ///< vessels: um, distance from the axis
  double radius = 0;            ///< vessels: um, radius at the closest point
  double parameter = 0;         ///< vessels: 0..1 along the segment
};

/// Gap to a triangle surface. Beyond `reach`, um, it is `reach`, and the normal is undefined.
Gap gap_to_mesh(const SurfaceBody& body, const Vec3& x, double reach);
/// Gap to a subset of its triangles, with the same limit.
Gap gap_to_triangles(const SurfaceBody& body, std::span<const int> triangles, const Vec3& x,
                     double reach);

/// Exact gap to the round cone of a segment, whose radius varies linearly between its ends.
Gap gap_to_segment(const geometry::Network& network, int segment, const Vec3& x);

}  // namespace acinus::contact
