#pragma once
/// Geometry of triangle surfaces. `triangle` is counter-clockwise seen from outside; lengths um.
/// "Closed" functions need a closed oriented surface (closed.hpp); they do not check it.

#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/closest_point.hpp"

namespace acinus::geometry {

using Triangles = std::span<const std::array<int, 3>>;

/// Enclosed volume, um^3, positive when outward; closed surfaces. Sum of x_i.(x_j x x_k)/6 taken
/// from the first node, so that a cell far from the origin keeps its digits.
double compute_volume(std::span<const Vec3> node, Triangles triangle);

/// Sum of the triangle areas, um^2.
double compute_area(std::span<const Vec3> node, Triangles triangle);

/// Centroid of the enclosed volume, um; closed surfaces with volume.
Vec3 compute_centroid(std::span<const Vec3> node, Triangles triangle);

/// Mean curvature at each node. [Meyer2003, Eq. (8) with the mixed area of Fig. 4]
struct MeanCurvature {
  std::vector<Vec3> normal;  ///< [n_node] H n, 1/um: half of K = 1/(2 A) sum (cot a + cot b)(x_i -
                             ///< x_j); outward on convex parts, length 1/R on a sphere
  std::vector<double> mixed_area;  ///< [n_node] um^2, sums to the surface area
};
/// Mean curvature of a closed surface; triangles of zero area add nothing. Nodes of no triangle get
/// zeros.
MeanCurvature compute_mean_curvature(std::span<const Vec3> node, Triangles triangle);

/// Shape of one triangle, 4 sqrt(3) area / (sum of squared sides): 1 = equilateral, 0 = degenerate.
double compute_triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// Smallest triangle quality of a surface; 1 when there is no triangle.
double compute_quality(std::span<const Vec3> node, Triangles triangle);

/// Distance of a point to a surface, um. Cost linear.
double compute_distance(const Vec3& p, std::span<const Vec3> node, Triangles triangle);

/// Winding number of a closed surface about p: 1 inside, 0 outside (round-off about 1e-13), sum of
/// the solid angles of the triangles / 4 pi [VanOosterom1983, Eq. (8)]. Between the two for p on
/// the surface itself. Cost linear.
double compute_winding_number(const Vec3& p, std::span<const Vec3> node, Triangles triangle);

/// True if p lies inside a closed outward surface: winding number above 1/2.
bool is_inside(const Vec3& p, std::span<const Vec3> node, Triangles triangle);

}  // namespace acinus::geometry
