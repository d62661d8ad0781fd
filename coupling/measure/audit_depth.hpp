#pragma once
/// How deep two bodies are in each other, as the audit measures it.

#include "core/box.hpp"
#include "core/vec.hpp"
#include "geometry/audit_body.hpp"

namespace acinus::coupling {

/// Deepest point of the surface of `a` on the forbidden side of `b`, um.
double surface_depth(const geometry::AuditBody& a, const geometry::AuditBody& b,
                     geometry::Location forbidden);

/// The same both ways, and of a volume centroid that lies in both.
double body_depth(const geometry::AuditBody& a, const geometry::AuditBody& b);

/// The balls along a straight axis.
struct RoundCone {
  Vec3 a, b;
  double radius_a, radius_b;
  Box box() const;
  double radius(double t) const { return radius_a + t * (radius_b - radius_a); }
};

/// Depth below the surface of the balls along the axis: max over t of r(t) - |p - c(t)|, um.
double cone_depth(const RoundCone& cone, const Vec3& p);

/// Of a cell in a vessel, um.
double vessel_depth(const geometry::AuditBody& cell, const RoundCone& cone);

}  // namespace acinus::coupling
