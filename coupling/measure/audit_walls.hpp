#pragma once
/// Walls as the audit sees them: where they stand at one moment, and a depth of their own, which
/// shares no code with the gaps that contacts are found by.

#include <variant>
#include <vector>

#include "core/contact/boundary.hpp"
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
using AuditWall = std::variant<AuditPlane, AuditCapsule>;

/// All walls in the order of for_each_wall.   @param time  s after t = 0
std::vector<AuditWall> make_audit_walls(const contact::Boundary& boundary, double time);

/// How far a ball reaches behind a wall, um; a point with radius 0. Negative: not at all.
double depth_behind(const AuditWall& wall, const Vec3& center, double radius);

}  // namespace acinus::coupling
