#include "coupling/measure/audit_walls.hpp"

namespace acinus::coupling {
namespace {

AuditWall at_time(const contact::Plane& p, double time) {
  return AuditPlane{p.point_at(time), p.normal};
}
AuditWall at_time(const contact::Capsule& c, double time) {
  return AuditCapsule{c.center, c.radius_at(time)};
}

double depth(const AuditPlane& p, const Vec3& center, double radius) {
  return radius - (center - p.point).dot(p.normal);
}
double depth(const AuditCapsule& c, const Vec3& center, double radius) {
  return (center - c.center).norm() + radius - c.radius;
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
