#include "coupling/generate/vessel_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::coupling {
namespace {

constexpr int kVesselSides = 10;
constexpr double kRingSpacing = 6;  // um

struct Ring {
  Vec3 center;
  double radius;
};

/// Rings along a segment: one on each round end (at 45 degrees), the others between.
std::vector<Ring> rings_of(const Vec3& a, const Vec3& b, double radius_a, double radius_b,
                           const Vec3& along) {
  const double length = (b - a).norm();
  const int n = std::max(1, static_cast<int>(std::ceil(length / kRingSpacing)));
  const double up = std::sin(kPi / 4), out = std::cos(kPi / 4);
  std::vector<Ring> ring;
  ring.push_back({a - up * radius_a * along, out * radius_a});
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    ring.push_back({a + t * (b - a), radius_a + t * (radius_b - radius_a)});
    if (length == 0) break;
  }
  ring.push_back({b + up * radius_b * along, out * radius_b});
  return ring;
}

void add_tube(const std::vector<Ring>& ring, const Vec3& tip_a, const Vec3& tip_b,
              const Vec3& along, geometry::Surface& surface) {
  // The axis least aligned with the tube gives a safe direction across.
  int axis = 0;
  along.cwiseAbs().minCoeff(&axis);
  const Vec3 u = along.cross(Vec3::Unit(axis)).normalized(), v = along.cross(u);
  const int first = static_cast<int>(surface.node.size());
  for (const Ring& r : ring)
    for (int side = 0; side < kVesselSides; ++side) {
      const double angle = 2 * kPi * side / kVesselSides;
      surface.node.push_back(r.center + r.radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  const int n_ring = static_cast<int>(ring.size());
  const int low_tip = static_cast<int>(surface.node.size()), high_tip = low_tip + 1;
  surface.node.push_back(tip_a);
  surface.node.push_back(tip_b);
  for (int side = 0; side < kVesselSides; ++side) {
    const int next = (side + 1) % kVesselSides;
    for (int r = 0; r + 1 < n_ring; ++r) {
      const int low = first + r * kVesselSides, high = low + kVesselSides;
      surface.triangle.push_back({low + side, low + next, high + next});
      surface.triangle.push_back({low + side, high + next, high + side});
    }
    const int last = first + (n_ring - 1) * kVesselSides;
    surface.triangle.push_back({low_tip, first + next, first + side});
    surface.triangle.push_back({high_tip, last + side, last + next});
  }
}

}  // namespace

geometry::Surface make_vessel_surface(const geometry::Network& network) {
  geometry::Surface surface;
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const Vec3 a = network.node[network.segment[s][0]];
    const Vec3 b = network.node[network.segment[s][1]];
    const auto [radius_a, radius_b] = network.radius[s];
    const double length = (b - a).norm();
    const Vec3 along = length > 0 ? Vec3((b - a) / length) : Vec3::UnitZ();
    add_tube(rings_of(a, b, radius_a, radius_b, along), a - radius_a * along, b + radius_b * along,
             along, surface);
  }
  return surface;
}

}  // namespace acinus::coupling
