#pragma once
/// Depth of two bodies in each other for the audit.

#include "core/box.hpp"
#include "core/vec.hpp"
#include "geometry/audit_body.hpp"

namespace acinus::coupling {

/// Largest depth of the surface of `a` on the forbidden side of `b`, um.
double surface_depth(const geometry::AuditBody& a, const geometry::AuditBody& b,
                     geometry::Location forbidden);

/// Largest depth both ways, and of a volume centroid inside both, um.
double body_depth(const geometry::AuditBody& a, const geometry::AuditBody& b);

/// Round cone: balls along a straight axis.
struct RoundCone {
  Vec3 a, b;
  double radius_a, radius_b;
  Box box() const;
  double radius(double t) const { return radius_a + t * (radius_b - radius_a); }
};

/// Depth of a point below the surface of a round cone: max over t of r(t) - |p - c(t)|, um.
double cone_depth(const RoundCone& cone, const Vec3& p);

/// Depth of a cell in a vessel, um.
double vessel_depth(const geometry::AuditBody& cell, const RoundCone& cone);

}  // namespace acinus::coupling
