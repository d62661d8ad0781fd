#include "geometry/implicit/vessel_field.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "geometry/segment_shape.hpp"

namespace acinus::geometry {

double crease_radius(double rounding, const geometry::NearestBall& a,
                     const geometry::NearestBall& b) {
  return rounding * std::min(a.radius, b.radius);
}

namespace {

struct Wall {
  double distance;  ///< um
  int piece;
};

/// Distance to the ball that rolls along a crease, at a place between the two walls that it
/// touches; elsewhere to the nearer wall.
double distance_in_crease(double rounding, const geometry::NearestBall& a,
                          const geometry::NearestBall& b) {
  constexpr double kStraight = 1e-9;
  const double to_a = a.apart.norm() - a.radius, to_b = b.apart.norm() - b.radius;
  const double nearer = std::min(to_a, to_b);
  const double radius = crease_radius(rounding, a, b);
  const double sum = 2 * radius - to_a - to_b;
  if (!(sum > 0)) return nearer;
  // Of the angle between the walls: 0 where they face each other, 2 where one goes straight on.
  const double alike = a.apart.normalized().dot(b.apart.normalized());
  const double open = std::max(1 + alike, kStraight), closed = std::max(1 - alike, kStraight);
  const double difference = std::abs(to_a - to_b);
  if (difference * open > sum * closed) return nearer;  // beyond where the ball touches
  return radius - std::sqrt(sum * sum / (2 * open) + difference * difference / (2 * closed));
}

}  // namespace

VesselField::VesselField(const geometry::Network& vessels, const VesselPieces& pieces,
                         double rounding)
    : vessels_(vessels), pieces_(pieces), rounding_(rounding) {
  const geometry::Network& n = pieces.network;
  for (std::size_t k = 0; k < pieces.whole.size(); ++k) {
    const auto& [a, b] = n.segment[k];
    cone_.emplace_back(n.node[a], n.node[b], n.radius[k][0], n.radius[k][1]);
    widest_ = std::max(widest_, crease_reach(static_cast<int>(k)));
  }
}

double VesselField::crease_reach(int piece) const {
  const auto& [a, b] = pieces_.network.radius[piece];
  return 2 * rounding_ * std::max(a, b);
}

double VesselField::distance(const Vec3& x, int piece) const { return cone_[piece].distance(x); }

double VesselField::value(const Vec3& x, std::span<const int> pieces) const {
  thread_local std::vector<Wall> near;
  near.clear();
  double least = std::numeric_limits<double>::infinity();
  for (const int k : pieces) {
    const double d = distance(x, k);
    least = std::min(least, d);
    if (d < widest_) near.push_back({d, k});
  }
  double rounded = least;
  for (auto a = near.begin(); a != near.end(); ++a)
    for (auto b = std::next(a); b != near.end(); ++b) {
      if (a->distance + b->distance >= std::min(crease_reach(a->piece), crease_reach(b->piece)))
        continue;
      const int s = pieces_.whole[a->piece], t = pieces_.whole[b->piece];
      if (s != t && geometry::share_a_node(vessels_, s, t))
        rounded = std::min(
            rounded,
            distance_in_crease(rounding_, geometry::nearest_ball(pieces_.network, a->piece, x),
                               geometry::nearest_ball(pieces_.network, b->piece, x)));
    }
  return rounded;
}

}  // namespace acinus::geometry
