#include "core/implicit/vessel_creases.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/implicit/vessel_field.hpp"
#include "core/mesh/segment_shape.hpp"

namespace acinus::implicit {
namespace {

/// A segment, from the node that it shares on.
struct Leaving {
  int segment = 0;
  std::size_t end = 0;  ///< of it, at the node
};

class SharpCreases {
 public:
  SharpCreases(const mesh::Network& network, double rounding, double of_radius)
      : n_(network), rounding_(rounding), of_radius_(of_radius) {}

  /// Looks from the wall of a segment at another that shares the node.
  void search(const Leaving& from, int other) {
    constexpr int kLines = 24;
    const auto [segment, end] = from;
    const auto& node = n_.segment[segment];
    const Vec3& start = n_.node[node[end]];
    const Vec3 along = n_.node[node[1 - end]] - start;
    const double length = along.norm(), at_node = n_.radius[segment][end];
    const double taper = (n_.radius[segment][1 - end] - at_node) / length;
    if (std::abs(taper) >= 1) return;  // a ball
    const Vec3 axis = along / length, u = axis.unitOrthogonal(), v = axis.cross(u);
    for (int k = 0; k < kLines; ++k) {
      const double angle = 2 * kPi * k / kLines;
      const Vec3 across = std::cos(angle) * u + std::sin(angle) * v;
      // Along the cone, where the normal stays, then about the ball at its far end.
      const Vec3 normal = std::sqrt(1 - taper * taper) * across - taper * axis;
      for (double x = 0; x < length; x += kStep * (at_node + taper * x))
        look(start + x * axis, at_node + taper * x, normal, other);
      const double far = at_node + taper * length;
      for (double tilt = -std::asin(taper); tilt < kPi / 2; tilt += kStep)
        look(start + along, far, std::cos(tilt) * across + std::sin(tilt) * axis, other);
    }
  }

  std::vector<FineBall> take() { return std::move(ball_); }

 private:
  /// From a place on the wall of one of the balls of a segment to the wall across the gap.
  void look(const Vec3& center, double radius, const Vec3& normal, int other) {
    const mesh::NearestBall own{0, radius, radius * normal};
    const mesh::NearestBall across = mesh::nearest_ball(n_, other, center + own.apart);
    const double distance = across.apart.norm();
    const double open = 1 + normal.dot(across.apart) / distance;  // 0: they face each other
    const double gap = distance - across.radius, step = kStep * radius;
    const double usual = of_radius_ * radius;
    // Just within the other vessel: the wall comes out of it before the next place.
    if (open > kMostOpen || gap < -step || gap > usual) return;
    // The gap is the smaller the nearer to the crease.
    const double least = gap - step * std::sqrt(2 * open);
    const double finest =
        std::max(kOfCrease * crease_radius(rounding_, own, across), kOfOpen * open * usual);
    const double size = std::max(kOfGap * least, finest);
    if (size < usual) ball_.push_back({center + own.apart, step, size});
  }

  /// Of the radius: between places along the wall.
  static constexpr double kStep = 0.3;
  static constexpr double kMostOpen = 1, kOfGap = 0.9, kOfCrease = 1.5, kOfOpen = 0.35;
  const mesh::Network& n_;
  double rounding_, of_radius_;
  std::vector<FineBall> ball_;
};

}  // namespace

std::vector<FineBall> find_sharp_creases(const mesh::Network& n, double rounding,
                                         double of_radius) {
  std::vector<std::vector<Leaving>> at(n.node.size());
  for (int s = 0; s < static_cast<int>(n.segment.size()); ++s)
    for (const std::size_t end : {0, 1}) at[n.segment[s][end]].push_back({s, end});
  SharpCreases out(n, rounding, of_radius);
  for (const std::vector<Leaving>& leaving : at)
    for (auto a = leaving.begin(); a != leaving.end(); ++a)
      for (auto b = leaving.begin(); b != a; ++b) {
        const bool thinner = n.radius[a->segment][a->end] < n.radius[b->segment][b->end];
        out.search(thinner ? *a : *b, (thinner ? *b : *a).segment);
      }
  return out.take();
}

}  // namespace acinus::implicit
