#pragma once
/// Contact law of the model paper between two triangles, and between a triangle and an object of a
/// given curvature: Maugis-Dugdale stress of their spheres, integrated over the area that both
/// share on the contact plane. [VanLiedekerke2020, Eq. (14) to (17), and section 2.1 for objects;
/// Odenthal2013]. A law without energy, which is continuous where neither sphere changes the sign
/// of its curvature. Steps use it only where the scene selects it
/// (dcm/contact/triangle_contact.hpp), the cohesive potential otherwise (cohesive.hpp).

#include <array>
#include <limits>
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
  /// Modulus of an elastic partner, kPa, E/(1 - nu^2), in series with E^ until the partner has
  /// yielded by its largest indentation, um. Beyond, it is rigid.
  double partner_modulus = std::numeric_limits<double>::infinity();
  double most_yield = std::numeric_limits<double>::infinity();
  /// Gap of two spheres beyond which nothing is computed, um. At least that at which forces end
  /// (least_overlap), or infinite.
  double farthest = std::numeric_limits<double>::infinity();
};

/// Reduced modulus of the law at an overlap of two spheres, kPa. Continuous; pressures grow with
/// the overlap.
double modulus_at(const MaugisLaw& law, double overlap);

/// Contact plane of two caps: the radical plane of their spheres, or the plane of a flat one.
struct ContactPlane {
  Vec3 point;      ///< um, intersection of the line of centres with the plane
  Vec3 normal;     ///< unit, along the line of centres, a to b
  double overlap;  ///< delta of the two spheres, um; negative: separated
  double radius;   ///< R^, um
};

/// Contact plane from the line of centres of two spheres. If one cap is concave, both get half of
/// the sum of curvatures: the gap between two surfaces depends, to the order of Hertz, on that sum
/// alone, while the line between the nearly concentric centres of a hollow and a ball in it would
/// be noise. Meshes flatter than a radius of 50 um share gradually, so that no force jumps where a
/// curvature changes its sign.
///
/// An object that bulges meets a hollow triangle as a flat one: R^ is at most the radius of the
/// object. A surface that fits about a thin vessel would have an R^ of up to the largest. Its
/// spheres would overlap far beside the triangles, which are not exactly parallel to the vessel,
/// and would leave triangles without a force that are deep in it.
ContactPlane compute_contact_plane(const SphericalCap& a, const SphericalCap& b, double max_radius);

/// Barycentric weights of the place of a triangle on the line through x along the normal.
std::array<double, 3> weights_along(const Vec3& normal, const std::array<Vec3, 3>& corner,
                                    const Vec3& x);

/// Forces on the corners, nN. They sum to zero and have no moment, both to round-off: stress acts
/// along the normal, with the same barycentric weights in a triangle as in its projection.
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
/// @param b_side  owner of b, a cell or the mesh of an object
TriangleContact compute_triangle_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                         const CurvedTriangle& b, CapOf b_side = CapOf::kCell);

/// Contact of a triangle with an object, of which it meets the sphere that touches it at a place:
/// the object itself if it is a plane or a ball. The area is that of the projected triangle.
/// @param b  rim radius 0
TriangleContact compute_object_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                       const SphericalCap& b);

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
