#include "core/implicit/vessel_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/contact/box_pairs.hpp"
#include "core/mesh/segment_shape.hpp"

namespace acinus::implicit {
namespace {

/// Part of a segment, by its parameter.
struct AxisPart {
  int segment = 0;
  double low = 0, high = 1;
};

struct NearestPlaces {
  double gap = 0;              ///< um, negative where walls cross
  Vec3 middle = Vec3::Zero();  ///< between the two walls
};

/// Along the axis of one, the distance to the other less the radius is convex: both bodies are.
NearestPlaces find_nearest_places(const mesh::Network& n, const AxisPart& piece, int other) {
  constexpr int kRounds = 50;
  constexpr double kGolden = 0.6180339887498949;
  const Vec3 a = n.node[n.segment[piece.segment][0]];
  const Vec3 along = n.node[n.segment[piece.segment][1]] - a;
  const auto& [ra, rb] = n.radius[piece.segment];
  const auto gap_at = [&](double t) {
    const mesh::NearestBall ball = mesh::nearest_ball(n, other, a + t * along);
    return ball.apart.norm() - ball.radius - (ra + t * (rb - ra));
  };
  double low = piece.low, high = piece.high;
  for (int k = 0; k < kRounds; ++k) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    if (gap_at(left) < gap_at(right))
      high = right;
    else
      low = left;
  }
  const double t = 0.5 * (low + high), radius = ra + t * (rb - ra);
  const mesh::NearestBall ball = mesh::nearest_ball(n, other, a + t * along);
  const double gap = ball.apart.norm() - ball.radius - radius;
  return {gap, a + t * along - (radius + 0.5 * gap) * ball.apart.normalized()};
}

/// Which segments are within some distance of each.
std::vector<std::vector<int>> find_beside(const mesh::Network& n, double most) {
  std::vector<Box> box;
  for (std::size_t s = 0; s < n.segment.size(); ++s) box.push_back(mesh::cone_box(n, s));
  std::vector<std::vector<int>> beside(n.segment.size());
  for (const auto& [s, t] : contact::find_pairs(box, most)) {
    beside[s].push_back(t);
    beside[t].push_back(s);
  }
  return beside;
}

class GapSearch {
 public:
  GapSearch(const mesh::Network& network, double most)
      : n_(network), most_(most), beside_(find_beside(network, most)) {}

  /// The smallest gap of a piece: negative where walls cross, `most` where there is none.
  double find(const AxisPart& piece) const {
    double least = most_;
    for (const int other : beside_[piece.segment])
      if (!mesh::share_a_node(n_, piece.segment, other))
        least = std::min(least, find_between(piece, other));
    return least;
  }
  /// Pairs of segments whose walls cross.
  int count_overlapping() const {
    int count = 0;
    for (int s = 0; s < static_cast<int>(beside_.size()); ++s)
      for (const int t : beside_[s])
        if (s < t && !mesh::share_a_node(n_, s, t) && find_between({s, 0, 1}, t) < 0) ++count;
    return count;
  }

 private:
  double find_between(const AxisPart& piece, int other) const {
    const NearestPlaces near = find_nearest_places(n_, piece, other);
    if (near.gap >= most_) return most_;
    // Neighbours along one vessel, with a short segment between them, are no gap.
    const bool filled = std::ranges::any_of(beside_[piece.segment], [&](int k) {
      if (k == other) return false;
      const mesh::NearestBall ball = mesh::nearest_ball(n_, k, near.middle);
      return ball.apart.norm() < ball.radius;
    });
    return filled ? most_ : near.gap;
  }

  const mesh::Network& n_;
  double most_;
  std::vector<std::vector<int>> beside_;
};

/// Ends of pieces about as long as the vessel is thick, from 0 to 1 along a segment.
std::vector<double> find_ends(const mesh::Network& n, std::size_t segment) {
  constexpr double kShortest = 0.005;
  const auto& [a, b] = n.segment[segment];
  const auto& [ra, rb] = n.radius[segment];
  const double length = (n.node[b] - n.node[a]).norm();
  std::vector<double> ends{0};
  while (ends.back() < 1) {
    const double t = ends.back(), step = std::max(kShortest, (ra + t * (rb - ra)) / length);
    ends.push_back(t + 1.5 * step < 1 ? t + step : 1);
  }
  return ends;
}

}  // namespace

VesselPieces cut_vessels(const mesh::Network& n, double of_radius) {
  constexpr double kOfGap = 0.9, kFinest = 0.1;
  double thickest = 0;
  for (const auto& [ra, rb] : n.radius) thickest = std::max({thickest, ra, rb});
  const GapSearch search(n, of_radius * thickest / kOfGap);
  VesselPieces out;
  out.network.node = n.node;
  out.overlapping = search.count_overlapping();
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    const auto [a, b] = n.segment[s];
    const auto [ra, rb] = n.radius[s];
    const auto radius_at = [&](double t) { return ra + t * (rb - ra); };
    const auto size_of = [&](double low, double high) {
      const double thinnest = std::min(ra, rb),
                   thin = std::min(radius_at(low), radius_at(high));
      // In powers of two, so that pieces of much the same size are one.
      const double wanted =
          of_radius * thinnest * std::exp2(std::floor(std::log2(thin / thinnest)));
      const double gap = search.find({static_cast<int>(s), low, high});
      // No edge is short enough for walls that cross.
      return gap > 0 ? std::clamp(kOfGap * gap, kFinest * wanted, wanted) : wanted;
    };
    const std::vector<double> end = find_ends(n, s);
    int from = a;
    double r_from = ra, before = size_of(0, end[1]);
    for (std::size_t k = 1; k < end.size(); ++k) {
      const bool last = k + 1 == end.size();
      const double next = last ? -1 : size_of(end[k], end[k + 1]);
      if (next == before) continue;  // one piece with the next
      int to = b;
      if (!last) {
        to = static_cast<int>(out.network.node.size());
        out.network.node.push_back(n.node[a] + end[k] * (n.node[b] - n.node[a]));
      }
      const double r_to = last ? rb : radius_at(end[k]);
      out.network.segment.push_back({from, to});
      out.network.radius.push_back({r_from, r_to});
      out.whole.push_back(static_cast<int>(s));
      out.size.push_back(before);
      from = to;
      r_from = r_to;
      before = next;
    }
  }
  return out;
}

}  // namespace acinus::implicit
