#pragma once
/// The contact law of the model paper between two triangles: Maugis-Dugdale stress of their
/// spheres, integrated over the area that both share on the contact plane. [VanLiedekerke2020, Eq.
/// (14) to (17); Odenthal2013]. A reference law, with no energy: the force jumps where the shared
/// polygon changes its corners. A step uses it only where the scene chooses it
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
  /// Largest reduced radius, um: what is flat on both sides, or hollow and fits, would have an
  /// infinite one, and a stress of zero.
  double max_radius = 1e3;
};

/// How two triangles meet.
struct TriangleMeeting {
  Vec3 point;      ///< um, where the line of centres crosses the contact plane
  Vec3 normal;     ///< unit, along the line of centres, a to b
  double overlap;  ///< delta of the two spheres, um; negative: apart
  double radius;   ///< R^, um
};

/// Line of centres and radical plane of the two spheres. If one triangle is hollow, or both
/// together are flatter than max_radius, both get half of the sum of curvatures: the gap between
/// two surfaces depends, to the order of Hertz, on that sum alone, while the line between the
/// nearly concentric centres of a hollow and a ball in it would be noise.
TriangleMeeting meet_triangles(const CurvedTriangle& a, const CurvedTriangle& b, double max_radius);

/// Forces on the corners, nN. They sum to zero and have no moment, both to round-off: each
/// quadrature point acts along the normal, with the same barycentric weights in a triangle as in
/// its projection.
struct TriangleForces {
  std::array<Vec3, 3> on_a = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, 3> on_b = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double normal_force = 0;  ///< nN, positive pushes apart
  double contact_area = 0;  ///< um^2 of the shared polygon within the radius c
};

/// All zero if the triangles do not face each other, share no area on the contact plane, or are
/// farther apart than adhesion reaches.
TriangleForces compute_triangle_forces(const MaugisLaw& law, const CurvedTriangle& a,
                                       const CurvedTriangle& b);

/// What pushes, or what pulls, of the stress between two triangles: one force at one place.
struct TrianglePart {
  double force = 0;                 ///< nN, positive pushes apart
  double area = 0;                  ///< um^2
  double slope = 0;                 ///< nN/um, growth of the force with the overlap, not negative
  std::array<double, 3> place_a{};  ///< barycentric weights of the centre of the force, within a
};

/// The same forces as those of TriangleForces: stress of one sign acts as one force at its centre,
/// on b at the place that lies behind it along the normal.
struct TriangleContact {
  Vec3 normal = Vec3::Zero();  ///< unit, a to b
  TrianglePart push, pull;     ///< area 0: there is none
};
TriangleContact compute_triangle_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                         const CurvedTriangle& b);

/// The sum over all pairs of triangles of two surfaces.
struct SurfaceForces {
  std::vector<Vec3> on_a, on_b;  ///< [n_node] nN
  double contact_area = 0;       ///< um^2
};

/// A surface as this law sees it.
struct CurvedSurface {
  int n_node;
  geometry::Triangles triangle;
  std::span<const CurvedTriangle> curved;  ///< [n_triangle]
};

/// Cost: all pairs are looked at, most only to see that they are farther apart than `reach`, um
/// (between the circumscribed circles).
SurfaceForces compute_surface_forces(const MaugisLaw& law, const CurvedSurface& a,
                                     const CurvedSurface& b, double reach);

}  // namespace acinus::contact
