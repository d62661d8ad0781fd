#pragma once
/// Triangle of a surface with the sphere through its three corners that has the local curvature:
/// the "circumscribing sphere" of the model paper (Fig. 2c).

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

/// Curved triangle from corners that enclose an area. A curvature above 1/circumradius, which no
/// sphere through the corners has, becomes 1/circumradius.
CurvedTriangle make_curved_triangle(const std::array<Vec3, 3>& corner, double curvature);

/// Owner of a cap: a cell; an object that is given by a mesh; an object whose surface is the sphere
/// itself.
enum class CapOf { kCell, kObjectMesh, kObject };

/// Spherical cap: the surface of a triangle's sphere above it, or the surface of an object around
/// the place that is nearest to a triangle.
struct SphericalCap {
  Vec3 middle;            ///< um, centre of the rim; of an object, the place on its surface
  Vec3 normal;            ///< unit, outward
  double rim_radius = 0;  ///< um, at most the radius of the sphere
  double curvature = 0;   ///< 1/um: 0 flat, negative of a hollow surface
  CapOf side = CapOf::kCell;
};
SphericalCap cap_of(const CurvedTriangle& t);

/// Sphere of a cap, um.
struct FittedSphere {
  Vec3 center;
  double radius;
};
/// Sphere of a cap with the given curvature, 1/um, in place of its own; at most that of a
/// hemisphere.
/// @pre curvature > 0 (asserted)
FittedSphere fit_sphere(const SphericalCap& cap, double curvature);

/// Curved triangles of a closed surface. The mean curvature of each, 1/um, is the mean over its
/// corners of the discrete Laplace-Beltrami operator (geometry::compute_mean_curvature), with the
/// sign relative to the triangle's own normal. [VanLiedekerke2020, section on contact]
std::vector<CurvedTriangle> make_curved_triangles(std::span<const Vec3> node,
                                                  geometry::Triangles triangle);

}  // namespace acinus::contact
