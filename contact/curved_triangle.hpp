#pragma once
/// A triangle of a surface with the sphere that the local curvature fits to it: the "circumscribing
/// sphere" of the model paper (Fig. 2c), through its three corners.

#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/measures.hpp"

namespace acinus::contact {

struct CurvedTriangle {
  std::array<Vec3, 3> corner;  ///< um, counter-clockwise seen from outside
  Vec3 normal;                 ///< unit, outward
  Vec3 circumcenter;           ///< um
  double circumradius;         ///< um
  double curvature;            ///< 1/um, mean curvature: 1/R on a sphere, 0 flat, negative hollow
};

/// A triangle with area; a curvature that no sphere through the corners has (above 1/circumradius)
/// becomes the largest that one has.
CurvedTriangle make_curved_triangle(const std::array<Vec3, 3>& corner, double curvature);

/// Radius and centre of its sphere if its curvature were `curvature`.
/// @pre 0 < curvature <= 1/circumradius (asserted)
struct FittedSphere {
  Vec3 center;
  double radius;
};
FittedSphere fit_sphere(const CurvedTriangle& t, double curvature);

/// Mean curvature of each triangle of a closed surface, 1/um: the mean over its corners of the
/// discrete Laplace-Beltrami operator (geometry::compute_mean_curvature), with the sign it has
/// towards the triangle's own normal. [VanLiedekerke2020, section on contact]
std::vector<CurvedTriangle> make_curved_triangles(std::span<const Vec3> node,
                                                  geometry::Triangles triangle);

}  // namespace acinus::contact
