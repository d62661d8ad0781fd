#include "coupling/generate/pipette_surface.hpp"

#include <cmath>
#include <vector>

namespace acinus::coupling {
namespace {

constexpr int kPipetteSides = 48;
constexpr int kArcSteps = 4;

/// Point of the section through the axis.
struct ProfilePoint {
  double radius = 0, height = 0;
};

/// Adds a quarter circle to the section, or a point for a sharp rim.
void add_corner(double radius, double height, double lip, double start,
                std::vector<ProfilePoint>& profile) {
  for (int k = 0; k <= (lip > 0 ? kArcSteps : 0); ++k) {
    const double angle = start + kPi / 2 * k / kArcSteps;
    profile.push_back({radius + lip * std::cos(angle), height + lip * std::sin(angle)});
  }
}

/// Closed section of the wall: inner rim of the mouth, outer rim, then the far end.
std::vector<ProfilePoint> profile_of(const contact::Pipette& p) {
  const double inner = p.radius + p.lip, outer = p.radius + p.thickness - p.lip;
  std::vector<ProfilePoint> profile;
  add_corner(inner, p.lip, p.lip, kPi, profile);
  add_corner(outer, p.lip, p.lip, -kPi / 2, profile);
  add_corner(outer, p.length - p.lip, p.lip, 0, profile);
  add_corner(inner, p.length - p.lip, p.lip, kPi / 2, profile);
  return profile;
}

}  // namespace

void add_pipette_surface(const contact::Pipette& p, geometry::Surface& surface) {
  const std::vector<ProfilePoint> profile = profile_of(p);
  const Vec3 u = p.axis.unitOrthogonal(), v = p.axis.cross(u);
  const int first = static_cast<int>(surface.node.size()), n = static_cast<int>(profile.size());
  for (int side = 0; side < kPipetteSides; ++side) {
    const double angle = 2 * kPi * side / kPipetteSides;
    const Vec3 out = std::cos(angle) * u + std::sin(angle) * v;
    for (const ProfilePoint& x : profile)
      surface.node.push_back(p.mouth + x.radius * out + x.height * p.axis);
  }
  for (int side = 0; side < kPipetteSides; ++side) {
    const int here = first + side * n, there = first + (side + 1) % kPipetteSides * n;
    for (int k = 0; k < n; ++k) {
      const int next = (k + 1) % n;
      surface.triangle.push_back({here + k, there + next, here + next});
      surface.triangle.push_back({here + k, there + k, there + next});
    }
  }
}

}  // namespace acinus::coupling
