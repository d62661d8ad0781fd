#include "core/implicit/vessel_field.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "core/mesh/segment_shape.hpp"

namespace acinus::implicit {

double crease_radius(double rounding, const mesh::NearestBall& a, const mesh::NearestBall& b) {
  return rounding * std::min(a.radius, b.radius);
}

namespace {

struct Wall {
  double distance;  ///< um
  int whole;        ///< segment
  mesh::NearestBall ball;
};

/// Distance to the ball that rolls along a crease, at a place between the two walls that it
/// touches; elsewhere to the nearer wall.
double distance_in_crease(double rounding, const Wall& a, const Wall& b) {
  constexpr double kStraight = 1e-9;
  const double nearer = std::min(a.distance, b.distance);
  const double radius = crease_radius(rounding, a.ball, b.ball);
  const double sum = 2 * radius - a.distance - b.distance;
  if (!(sum > 0)) return nearer;
  // Of the angle between the walls: 0 where they face each other, 2 where one goes straight on.
  const double alike = a.ball.apart.normalized().dot(b.ball.apart.normalized());
  const double open = std::max(1 + alike, kStraight), closed = std::max(1 - alike, kStraight);
  const double difference = std::abs(a.distance - b.distance);
  if (difference * open > sum * closed) return nearer;  // beyond where the ball touches
  return radius - std::sqrt(sum * sum / (2 * open) + difference * difference / (2 * closed));
}

}  // namespace

VesselField::VesselField(const mesh::Network& vessels, const VesselPieces& pieces, double rounding)
    : vessels_(vessels), pieces_(pieces), rounding_(rounding) {
  for (int k = 0; k < static_cast<int>(pieces.whole.size()); ++k)
    widest_ = std::max(widest_, crease_reach(k));
}

double VesselField::crease_reach(int piece) const {
  const auto& [a, b] = pieces_.network.radius[piece];
  return 2 * rounding_ * std::max(a, b);
}

double VesselField::distance(const Vec3& x, int piece) const {
  const mesh::NearestBall ball = mesh::nearest_ball(pieces_.network, piece, x);
  return ball.apart.norm() - ball.radius;
}

double VesselField::value(const Vec3& x, std::span<const int> pieces) const {
  thread_local std::vector<Wall> near;
  near.clear();
  double least = std::numeric_limits<double>::infinity();
  for (const int k : pieces) {
    const mesh::NearestBall ball = mesh::nearest_ball(pieces_.network, k, x);
    const double d = ball.apart.norm() - ball.radius;
    least = std::min(least, d);
    if (d < widest_) near.push_back({d, pieces_.whole[k], ball});
  }
  double rounded = least;
  for (auto a = near.begin(); a != near.end(); ++a)
    for (auto b = std::next(a); b != near.end(); ++b)
      if (a->whole != b->whole && mesh::share_a_node(vessels_, a->whole, b->whole))
        rounded = std::min(rounded, distance_in_crease(rounding_, *a, *b));
  return rounded;
}

}  // namespace acinus::implicit
