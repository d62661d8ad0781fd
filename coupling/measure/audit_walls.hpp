#pragma once
/// Walls of the audit: positions at one time and depths behind them, without code shared with the
/// contact search.

#include <variant>
#include <vector>

#include "contact/boundary.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

struct AuditPlane {  ///< inside is (x - point) . normal >= 0; unit normal
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};
struct AuditCapsule {  ///< sphere with cells inside
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
/// Ring-shaped wall: a ball of radius `lip` swept over a rectangle in a half-plane through the
/// axis, rotated about the axis. Without a lip its section is the rectangle.
struct AuditPipette {
  Vec3 mouth = Vec3::Zero(), axis = Vec3::UnitZ();
  double inner = 0, outer = 0;  ///< um, of the swept rectangle: distances from the axis
  double near = 0, far = 0;     ///< um, distances along the axis from the mouth
  double lip = 0;               ///< um; negative infinity after removal
};
using AuditWall = std::variant<AuditPlane, AuditCapsule, AuditPipette>;

/// Walls in the order of for_each_wall.   @param time  s since t = 0
std::vector<AuditWall> make_audit_walls(const contact::Boundary& boundary, double time);

/// Depth of a ball behind a wall, um; negative: gap. A point has radius 0.
double depth_behind(const AuditWall& wall, const Vec3& center, double radius);

}  // namespace acinus::coupling
