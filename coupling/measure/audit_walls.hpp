#pragma once
/// Walls as the audit sees them: where they stand at one moment, and a depth of their own, which
/// shares no code with the gaps that contacts are found by.

#include <variant>
#include <vector>

#include "contact/boundary.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

struct AuditPlane {  ///< cells stay where (x - point) . normal >= 0; normal of length 1
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};
struct AuditCapsule {  ///< cells live inside this sphere
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
/// A ball of the radius `lip` swept over the rectangle of a half-plane through the axis, and that
/// turned about the axis. What of it is left without a lip is a rectangle.
struct AuditPipette {
  Vec3 mouth = Vec3::Zero(), axis = Vec3::UnitZ();
  double inner = 0, outer = 0;  ///< um, of the swept rectangle: distances from the axis
  double near = 0, far = 0;     ///< um, the same along it, from the mouth
  double lip = 0;               ///< um; negative infinity once it is gone
};
using AuditWall = std::variant<AuditPlane, AuditCapsule, AuditPipette>;

/// All walls in the order of for_each_wall.   @param time  s after t = 0
std::vector<AuditWall> make_audit_walls(const contact::Boundary& boundary, double time);

/// How far a ball reaches behind a wall, um; a point with radius 0. Negative: not at all.
double depth_behind(const AuditWall& wall, const Vec3& center, double radius);

}  // namespace acinus::coupling
