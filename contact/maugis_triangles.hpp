#pragma once
/// Contact law of the model paper between two triangles: Maugis-Dugdale stress of their spheres,
/// integrated over the area that both share on the contact plane. [VanLiedekerke2020, Eq. (14) to
/// (17); Odenthal2013]. A reference law without energy: the force jumps where the shared polygon
/// changes its corners. Steps use it only where the scene selects it
/// (dcm/contact/triangle_contact.hpp), the cohesive potential otherwise (cohesive.hpp).

#include <array>
#include <span>
#include <vector>

#include "contact/curved_triangle.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

struct MaugisLaw {
  double modulus = 0;          ///< E^ in kPa
  double adhesion = 0;         ///< W in nN/um
  double cohesive_stress = 0;  ///< sigma0 in kPa: the range is h0 = W/sigma0; not read if W = 0
  /// Largest reduced radius, um. Flat or conforming surfaces would have an infinite one, and a
  /// stress of zero.
  double max_radius = 1e3;
};

/// Contact plane of two triangles: the radical plane of their spheres.
struct ContactPlane {
  Vec3 point;      ///< um, intersection of the line of centres with the plane
  Vec3 normal;     ///< unit, along the line of centres, a to b
  double overlap;  ///< delta of the two spheres, um; negative: separated
  double radius;   ///< R^, um
};

/// Contact plane from the line of centres of two spheres. If one triangle is concave, or both
/// together are flatter than max_radius, both get half of the sum of curvatures: the gap between
/// two surfaces depends, to the order of Hertz, on that sum alone, while the line between the
/// nearly concentric centres of a hollow and a ball in it would be noise.
ContactPlane compute_contact_plane(const CurvedTriangle& a, const CurvedTriangle& b,
                                   double max_radius);

/// Forces on the corners, nN. They sum to zero and have no moment, both to round-off: each
/// quadrature point acts along the normal, with the same barycentric weights in a triangle as in
/// its projection.
struct TriangleForces {
  std::array<Vec3, 3> on_a = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, 3> on_b = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double normal_force = 0;  ///< nN, positive pushes apart
  double contact_area = 0;  ///< um^2 of the shared polygon within the radius c
};

/// Forces between two triangles. All zero if the triangles do not face each other, share no area on
/// the contact plane, or are separated by more than the range of adhesion.
TriangleForces compute_triangle_forces(const MaugisLaw& law, const CurvedTriangle& a,
                                       const CurvedTriangle& b);

/// Repulsive or attractive part of the stress between two triangles: one force at one place.
struct TrianglePart {
  double force = 0;                 ///< nN, positive pushes apart
  double area = 0;                  ///< um^2
  double slope = 0;                 ///< nN/um, derivative of the force by overlap, not negative
  std::array<double, 3> place_a{};  ///< barycentric weights of the centre of the force, within a
};

/// Forces of TriangleForces as two resultants: stress of one sign acts as one force at its centre,
/// on b at the place behind it along the normal.
struct TriangleContact {
  Vec3 normal = Vec3::Zero();  ///< unit, a to b
  TrianglePart push, pull;     ///< area 0: no such part
};
TriangleContact compute_triangle_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                         const CurvedTriangle& b);

/// Forces between two surfaces, summed over all pairs of triangles.
struct SurfaceForces {
  std::vector<Vec3> on_a, on_b;  ///< [n_node] nN
  double contact_area = 0;       ///< um^2
};

/// Surface of curved triangles.
struct CurvedSurface {
  int n_node;
  geometry::Triangles triangle;
  std::span<const CurvedTriangle> curved;  ///< [n_triangle]
};

/// Forces between two surfaces. Cost: all pairs of triangles are visited; most are rejected by the
/// distance of their circumscribed circles.
/// @param reach  um, largest distance of these circles that is evaluated
SurfaceForces compute_surface_forces(const MaugisLaw& law, const CurvedSurface& a,
                                     const CurvedSurface& b, double reach);

}  // namespace acinus::contact
