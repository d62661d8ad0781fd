#include "geometry/implicit/vessel_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "geometry/box_pairs.hpp"
#include "geometry/implicit/vessel_field.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::geometry {
namespace {

/// Point on the wall of a segment, with the ball that touches it there.
struct WallPlace {
  Vec3 center;
  double radius;
  Vec3 normal;
};

/// Wall of a segment, parametrised by the angle about its axis and the length along it, um: 0 where
/// the cone begins, less on the cap before, more than its length on the cap behind.
class SegmentWall {
 public:
  SegmentWall(const geometry::Network& n, int segment) {
    const auto& [a, b] = n.segment[segment];
    start_ = n.node[a];
    axis_ = n.node[b] - n.node[a];
    length_ = axis_.norm();
    radius_ = n.radius[segment];
    axis_ = length_ > 0 ? Vec3(axis_ / length_) : Vec3::UnitX();
    across_ = axis_.unitOrthogonal();
    const double taper = (radius_[1] - radius_[0]) / length_;
    if (std::abs(taper) < 1) {
      tilt_ = -std::asin(taper);
    } else {  // one end holds the other: a ball
      if (radius_[1] > radius_[0]) start_ += length_ * axis_;
      radius_.fill(std::max(radius_[0], radius_[1]));
      length_ = tilt_ = 0;
    }
  }
  double begin() const { return -radius_[0] * (kPi / 2 + tilt_); }
  double end() const { return length_ + radius_[1] * (kPi / 2 - tilt_); }

  WallPlace at(double along, double angle) const {
    const double on_axis = std::clamp(along, 0.0, length_), on_cap = along - on_axis;
    const double tilt = tilt_ + on_cap / radius_[on_cap < 0 ? 0 : 1];
    const Vec3 out = std::cos(angle) * across_ + std::sin(angle) * axis_.cross(across_);
    return {start_ + on_axis * axis_, radius(on_axis),
            std::cos(tilt) * out + std::sin(tilt) * axis_};
  }
  /// Smallest and largest radius, um.
  std::pair<double, double> radii(double from, double to) const {
    return std::minmax(radius(std::clamp(from, 0.0, length_)),
                       radius(std::clamp(to, 0.0, length_)));
  }

 private:
  double radius(double on_axis) const {
    return length_ > 0 ? radius_[0] + on_axis / length_ * (radius_[1] - radius_[0]) : radius_[0];
  }
  Vec3 start_, axis_, across_;
  double length_ = 0, tilt_ = 0;  ///< angle of the cone's normal to the plane across the axis
  std::array<double, 2> radius_{};
};

/// True if a segment other than the two given contains the ball.
bool is_filled(const geometry::Network& n, const Vec3& x, double radius, int s, int t,
               std::span<const int> nearby) {
  return std::ranges::any_of(nearby, [&](int k) {
    if (k == s || k == t) return false;
    const geometry::NearestBall ball = geometry::nearest_ball(n, k, x);
    return ball.apart.norm() + radius < ball.radius;
  });
}

/// Search for gaps from the wall of one vessel to another.
class GapSearch {
 public:
  GapSearch(const geometry::Network& network, double rounding, double of_radius)
      : n_(network), rounding_(rounding), of_radius_(of_radius) {}

  /// Adds fine balls in the gap between two segments.
  /// @param joined  there is a crease between them
  /// @param beside  segments near the first
  void search(int segment, int other, bool joined, std::span<const int> beside) {
    constexpr int kSectors = 4;
    wall_ = SegmentWall(n_, segment);
    segment_ = segment;
    other_ = other;
    beside_ = beside;
    joined_ = joined;
    const double half = 0.5 * (wall_->end() - wall_->begin());
    for (int k = 0; k < kSectors; ++k)
      visit({wall_->begin() + half, 2 * kPi * k / kSectors, half, kPi / kSectors});
  }

  std::vector<FineBall> take() { return std::move(ball_); }

 private:
  /// Part of the wall: its centre, and its extent to both sides.
  struct Patch {
    double along, angle, half_along, half_angle;
  };

  void visit(const Patch& p) {
    const auto [thinnest, thickest] = wall_->radii(p.along - p.half_along, p.along + p.half_along);
    const double half_across = p.half_angle * thickest;
    const double reach = std::hypot(p.half_along, half_across);
    const WallPlace here = wall_->at(p.along, p.angle);
    const geometry::NearestBall own{0, here.radius, here.radius * here.normal};
    const geometry::NearestBall across =
        geometry::nearest_ball(n_, other_, here.center + own.apart);
    const double distance = across.apart.norm(), gap = distance - across.radius;
    if (gap + reach < 0 || gap - reach > of_radius_ * thickest) return;
    // Between the normals, 0 where the walls face each other; and by how much it may change.
    const double cosine = distance > 0 ? -here.normal.dot(across.apart) / distance : 1;
    const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double bend = reach * (1 / thinnest + 1 / across.radius);
    if (turn - (bend > kLargestTurn ? bend : 0) > kPi / 2) return;
    const double least = gap - reach * std::sin(std::min(turn + bend, kPi / 2));
    const double usual = of_radius_ * thinnest;
    double finest = kFinest * usual;
    if (joined_)
      finest = std::max(kOfCrease * crease_radius(rounding_, own, across),
                        kOfOpen * usual * (1 - std::cos(turn)));
    const double size = std::max(kOfGap * least, finest);
    if (bend <= kLargestTurn && size >= usual) return;
    const Vec3 x = here.center + own.apart;
    if (bend > kLargestTurn || reach > kLargestPatch * size) {
      split(p, half_across);
    } else if (!is_filled(n_, x, reach, segment_, other_, beside_)) {
      ball_.push_back({x, reach, size});
    }
  }

  void split(const Patch& p, double half_across) {
    Patch a = p, b = p;
    if (p.half_along > half_across) {
      a.half_along = b.half_along = 0.5 * p.half_along;
      a.along -= a.half_along;
      b.along += b.half_along;
    } else {
      a.half_angle = b.half_angle = 0.5 * p.half_angle;
      a.angle -= a.half_angle;
      b.angle += b.half_angle;
    }
    visit(a);
    visit(b);
  }

  /// Bounds of a patch that has one size: extent over that size, and turn of its normals.
  static constexpr double kLargestPatch = 2, kLargestTurn = 0.5;
  static constexpr double kOfGap = 0.9, kOfCrease = 1.5, kOfOpen = 0.35, kFinest = 0.015;
  const geometry::Network& n_;
  double rounding_, of_radius_;
  std::optional<SegmentWall> wall_;
  int segment_ = 0, other_ = 0;
  bool joined_ = false;
  std::span<const int> beside_;
  std::vector<FineBall> ball_;
};

struct NearestPlaces {
  double gap = 0;              ///< um, negative where walls cross
  Vec3 middle = Vec3::Zero();  ///< between the two walls
};

/// Places of two segments where their walls are nearest. Along the axis of one, the distance to the
/// other less the radius is convex: both bodies are.
NearestPlaces find_nearest_places(const geometry::Network& n, int segment, int other) {
  constexpr int kRounds = 50;
  constexpr double kGolden = 0.6180339887498949;
  const Vec3 a = n.node[n.segment[segment][0]];
  const Vec3 along = n.node[n.segment[segment][1]] - a;
  const auto& [ra, rb] = n.radius[segment];
  const auto gap_at = [&](double t) {
    const geometry::NearestBall ball = geometry::nearest_ball(n, other, a + t * along);
    return ball.apart.norm() - ball.radius - (ra + t * (rb - ra));
  };
  double low = 0, high = 1;
  for (int k = 0; k < kRounds; ++k) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    if (gap_at(left) < gap_at(right))
      high = right;
    else
      low = left;
  }
  const double t = 0.5 * (low + high), radius = ra + t * (rb - ra);
  const geometry::NearestBall ball = geometry::nearest_ball(n, other, a + t * along);
  const double gap = ball.apart.norm() - ball.radius - radius;
  return {gap, a + t * along - (radius + 0.5 * gap) * ball.apart.normalized()};
}

}  // namespace

VesselGaps find_narrow_gaps(const geometry::Network& n, double rounding, double of_radius) {
  std::vector<Box> box;
  double thickest = 0;
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    box.push_back(geometry::cone_box(n, s));
    thickest = std::max({thickest, n.radius[s][0], n.radius[s][1]});
  }
  const std::vector<std::pair<int, int>> pairs = find_pairs(box, of_radius * thickest);
  std::vector<std::vector<int>> beside(n.segment.size());
  for (const auto& [s, t] : pairs) {
    beside[s].push_back(t);
    beside[t].push_back(s);
  }
  GapSearch search(n, rounding, of_radius);
  VesselGaps out;
  for (const auto& [s, t] : pairs) {
    bool joined = geometry::share_a_node(n, s, t);
    if (!joined) {
      const NearestPlaces near = find_nearest_places(n, s, t);
      // Neighbours along one vessel, with a short segment between them, have a crease as well.
      joined = is_filled(n, near.middle, 0, s, t, beside[s]);
      if (!joined && near.gap < 0) {  // no edge is short enough for walls that cross
        ++out.overlapping;
        continue;
      }
    }
    const auto thinnest = [&](int k) { return std::min(n.radius[k][0], n.radius[k][1]); };
    const int from = thinnest(s) < thinnest(t) ? s : t;
    search.search(from, from == s ? t : s, joined, beside[from]);
  }
  out.fine = search.take();
  return out;
}

}  // namespace acinus::geometry
