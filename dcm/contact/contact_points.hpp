#pragma once
/// Points of a surface that contacts are seen from: where they are, and how much of it they stand
/// for.

#include <cstddef>

#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "dcm/contact/contact_params.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Guards: nodes and face centres deep inside a vessel are pushed out, without adhesion or
/// friction. Three-point quadrature would not see a vessel's tip in the middle of a face, nor the
/// tip of a corner at a vessel, and the quadratures with nodes not a thin vessel between the points
/// (so there only face centres guard). Walls that are flat or hollow have no tips. The number of a
/// guard is that of its node, or the number of nodes and that of its face.
///
/// Points at which a vessel yields no more have a second contact with what is missing to the full
/// stiffness; of both its onset is above zero.

/// Share of its area that a guard pushes with, and how deep inside, um, it begins to: the
/// quadrature points carry all that ordinary contact needs, and a point that joins in and leaves
/// again at every step would only make noise. In a wall that yields they begin where it yields no
/// more, as far as it is what yields.
inline constexpr double kGuardShare = 0.25, kGuardGap = 0.05;

/// Test for a contact of two triangles, whose place on side a is its own, not that of a
/// point.
inline bool is_between_triangles(const ContactParams& c, const contact::Contact& k) {
  return c.law == ContactLaw::kMaugisDugdale && k.partner == contact::Partner::kSurface &&
         !k.is_fold();
}

/// The nodes and weights of a contact's point; or of its place between triangles.
contact::PointStencil stencil_of(const ContactParams& c, const contact::SurfaceBody& body,
                                 const contact::Contact& contact);

/// Nodes and weights of a contact that is known to be one of a point.
contact::PointStencil probe_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                    const contact::Contact& contact);

/// Guarding points of a body, and the reference area each stands for, um^2.
inline std::size_t n_guards(const contact::SurfaceBody& b) {
  return b.node.size() + b.triangle->size();
}
double guard_area(const geometry::Topology& t, int point, double radius);

/// Surface area that a probing point stands for, um^2: its share of the reference surface.
double point_area(const geometry::Topology& t, contact::Quadrature q, int point, double radius);

/// Present area of the triangles about a point over their area at rest, which a birth shape does
/// not change: times point_area, the present area that the point stands for.
double point_stretch(const contact::SurfaceBody& body, contact::Quadrature q, int point,
                     double radius);

}  // namespace acinus::dcm
