#pragma once
/// Probing points and guards of a surface: their stencils and areas.

#include <cstddef>

#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "dcm/contact/contact_params.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Guards: nodes and face centres deep inside a vessel, which are pushed out without adhesion or
/// friction. Three-point quadrature misses the tip of a vessel in the middle of a face and the tip
/// of a corner at a vessel. The quadratures with nodes miss a thin vessel between the points, so
/// that only face centres guard there. Flat and hollow walls have no tips. A guard has the number
/// of its node, or the number of nodes plus that of its face.
///
/// A point at the indentation limit of a vessel has a second contact with the stiffness that the
/// first one lacks; the onset of the second is above zero.

/// Share of its area with which a guard pushes, and the depth inside at which it begins to, um. The
/// quadrature points carry ordinary contact, and a point that came and went at every step would
/// only add noise. In an elastic wall the onset rises towards the indentation limit with the
/// compliance of the wall.
inline constexpr double kGuardShare = 0.25, kGuardGap = 0.05;

/// Test for a contact of a triangle. Its place on side a is its own, not that of a point.
inline bool is_triangle_contact(const ContactParams& c, const contact::Contact& k) {
  return c.law == ContactLaw::kMaugisDugdale && k.partner != contact::Partner::kNucleus &&
         k.point != contact::kWhole && !k.is_fold();
}

/// Stencil of a contact: that of its point, or of its place if it is of a triangle.
contact::PointStencil stencil_of(const ContactParams& c, const contact::SurfaceBody& body,
                                 const contact::Contact& contact);

/// Stencil of a contact that is known to be at a point.
contact::PointStencil probe_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                    const contact::Contact& contact);

/// Number of guards of a body.
inline std::size_t n_guards(const contact::SurfaceBody& b) {
  return b.node.size() + b.triangle->size();
}
/// Reference area of a guard, um^2.
double guard_area(const geometry::Topology& t, int point, double radius);

/// Reference surface area of a probing point, um^2.
double point_area(const geometry::Topology& t, contact::Quadrature q, int point, double radius);

/// Ratio of the present area of the triangles about a point to their area at rest, which a birth
/// shape does not change. Times point_area it is the present area of the point.
double point_stretch(const contact::SurfaceBody& body, contact::Quadrature q, int point,
                     double radius);

}  // namespace acinus::dcm
