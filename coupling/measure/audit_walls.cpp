#include "coupling/measure/audit_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers/time_grid.hpp"

namespace acinus::coupling {
namespace {

AuditWall at_time(const contact::Plane& p, double time) {
  return AuditPlane{p.point_at(time), p.normal};
}
AuditWall at_time(const contact::Capsule& c, double time) {
  return AuditCapsule{c.center, c.radius_at(time)};
}

AuditWall at_time(const contact::Pipette& p, double time) {
  const double lip = time > p.opens + kSameTime ? -std::numeric_limits<double>::infinity() : p.lip;
  return AuditPipette{
      p.mouth,          p.axis, p.radius + p.lip, p.radius + p.thickness - p.lip, p.lip,
      p.length - p.lip, lip};
}

double depth(const AuditPlane& p, const Vec3& center, double radius) {
  return radius - (center - p.point).dot(p.normal);
}
double depth(const AuditCapsule& c, const Vec3& center, double radius) {
  return (center - c.center).norm() + radius - c.radius;
}
double depth(const AuditPipette& p, const Vec3& center, double radius) {
  const Vec3 from = center - p.mouth;
  const double z = from.dot(p.axis), r = from.cross(p.axis).norm();
  const double to_r = r - std::clamp(r, p.inner, p.outer), to_z = z - std::clamp(z, p.near, p.far);
  double distance = std::sqrt(to_r * to_r + to_z * to_z);
  if (distance == 0)
    distance = -std::min(std::min(r - p.inner, p.outer - r), std::min(z - p.near, p.far - z));
  return p.lip + radius - distance;
}

}  // namespace

std::vector<AuditWall> make_audit_walls(const contact::Boundary& boundary, double time) {
  std::vector<AuditWall> walls;
  contact::for_each_wall(
      boundary, [&](auto, auto, const auto& wall) { walls.push_back(at_time(wall, time)); });
  return walls;
}

double depth_behind(const AuditWall& wall, const Vec3& center, double radius) {
  return std::visit([&](const auto& w) { return depth(w, center, radius); }, wall);
}

}  // namespace acinus::coupling
