#include "dcm/shape/available_volume.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dcm/shape/cast.hpp"
#include "geometry/measures.hpp"
#include "geometry/star.hpp"

namespace acinus::dcm {
namespace {

/// Nodes of the sphere that samples an available volume and over whose faces meshes are spread.
constexpr int kShowingNodes = 642;
constexpr double kLeastShare = 0.25;
constexpr int kMostTrials = 60;                                       ///< of a radius
constexpr double kRadiusTolerance = 1e-14, kVolumeTolerance = 1e-12;  ///< relative
constexpr int kCentrings = 4;        ///< Newton steps of a ball's centre
constexpr double kLeastSlope = 0.1;  ///< smallest motion of the centroid per offset that counts
constexpr double kMostOffset = 0.3;  ///< of a ball's centre, in its radii

/// Distance from the centre of the volume to the ball's surface, um.
double reach_to_ball(const Vec3& direction, const CuttingBall& ball) {
  const double along = direction.dot(ball.offset);
  return along + std::sqrt(ball.radius * ball.radius - ball.offset.squaredNorm() + along * along);
}

const geometry::Topology& showing_sphere() { return geometry::shared_icosphere(kShowingNodes); }

const std::vector<Vec3>& showing_directions() {
  static const std::vector<Vec3> directions = [] {
    std::vector<Vec3> all;
    for (const Vec3& rest : showing_sphere().rest) all.push_back(rest.normalized());
    return all;
  }();
  return directions;
}

}  // namespace

double share_of_distance(double radius, double other_radius, double distance) {
  const double share =
      0.5 * (1 + (radius * radius - other_radius * other_radius) / (distance * distance));
  return std::clamp(share, kLeastShare, 1 - kLeastShare);
}

double reach_to_faces(const Vec3& direction, double farthest, std::span<const VolumeFace> face) {
  double reach = farthest;
  for (const VolumeFace& f : face) {
    const double slope = f.normal.dot(direction);
    if (slope * reach > f.distance) reach = f.distance / slope;
  }
  return reach;
}

AvailableVolume::AvailableVolume(const Vec3& center, Reach reach)
    : center_(center), reach_(std::move(reach)) {
  for (const Vec3& direction : showing_directions()) shown_.push_back(reach_(direction));
}

std::vector<Vec3> AvailableVolume::show(const CuttingBall& ball) const {
  std::vector<Vec3> node;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Vec3& d = showing_directions()[i];
    node.push_back(center_ + std::min(shown_[i], reach_to_ball(d, ball)) * d);
  }
  return node;
}

double AvailableVolume::volume(const CuttingBall& ball) const {
  return geometry::compute_volume(show(ball), showing_sphere().triangle);
}

double AvailableVolume::find_radius(double wanted, double largest, const Vec3& offset) const {
  const auto excess = [&](double radius) { return volume({radius, offset}) - wanted; };
  double low = offset.norm(), high = largest, above = excess(high);
  if (above <= 0) return largest;
  // Regula falsi; the value at an end that stays is halved (Illinois).
  double below = excess(low), radius = low;
  for (int k = 0, side = 0; k < kMostTrials && high - low > kRadiusTolerance * largest; ++k) {
    radius = (low * above - high * below) / (above - below);
    const double here = excess(radius);
    if (std::abs(here) <= kVolumeTolerance * wanted) break;
    if (here < 0) {
      low = radius;
      below = here;
      if (side < 0) above /= 2;
      side = -1;
    } else {
      high = radius;
      above = here;
      if (side > 0) below /= 2;
      side = 1;
    }
  }
  return radius;
}

/// Derivative of the centroid with respect to the ball's offset at fixed volume.
Mat3 AvailableVolume::centroid_by_offset(const CuttingBall& ball) const {
  Mat3 moment = Mat3::Zero();
  Vec3 first = Vec3::Zero(), third = Vec3::Zero();
  double area = 0, size = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Vec3& d = showing_directions()[i];
    const double free = reach_to_ball(d, ball), reach = std::min(shown_[i], free);
    size += reach * reach * reach / 3;
    if (shown_[i] < free) continue;
    moment += reach * reach * reach * d * d.transpose();
    third += reach * reach * reach * d;
    first += reach * reach * d;
    area += reach * reach;
  }
  if (!(area > 0)) return Mat3::Zero();
  return (moment - third * first.transpose() / area) / size;
}

CuttingBall AvailableVolume::find_ball(double wanted, double largest) const {
  CuttingBall ball{find_radius(wanted, largest)};
  for (int k = 0; k < kCentrings && ball.radius < largest; ++k) {
    const Vec3 away = geometry::compute_centroid(show(ball), showing_sphere().triangle) - center_;
    const Mat3 slope = centroid_by_offset(ball);
    const Mat3 damped = slope.transpose() * slope + kLeastSlope * kLeastSlope * Mat3::Identity();
    CuttingBall next{0, ball.offset - damped.ldlt().solve(slope.transpose() * away)};
    const double most = kMostOffset * ball.radius;
    if (next.offset.norm() > most) next.offset *= most / next.offset.norm();
    next.radius = find_radius(wanted, largest, next.offset);
    ball = next;
  }
  return ball;
}

std::vector<Vec3> AvailableVolume::fill(const geometry::Topology& t,
                                        std::span<const Vec3> direction,
                                        const CuttingBall& ball) const {
  std::vector<Vec3> cast;
  for (const Vec3& d : direction)
    cast.push_back(center_ + std::min(reach_(d), reach_to_ball(d, ball)) * d);
  std::vector<Vec3> node = cast;
  const geometry::StarSurface star({show(ball), showing_sphere().triangle}, center_);
  const std::vector<Part> part(node.size(), Part::kShell);
  spread_nodes(t, star, {part, showing_sphere().n_triangle}, node);
  // Spreading evens out long triangles beside rims; where it does not help, the cast nodes are
  // used.
  return geometry::compute_quality(node, t.triangle) > geometry::compute_quality(cast, t.triangle)
             ? node
             : cast;
}

}  // namespace acinus::dcm
