#pragma once
/// Networks whose segments meet only where they share a node.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/network.hpp"
#include "geometry/round_cone.hpp"

namespace acinus::geometry {

/// Grows a network segment by segment; one that would come nearer to others than a share of its
/// radius is drawn anew. Some segments close a loop.
class RandomNetwork {
 public:
  RandomNetwork(unsigned seed, double thinnest, double thickest)
      : random_(seed), thinnest_(thinnest), thickest_(thickest) {}

  geometry::Network grow(std::size_t n_segment) {
    add_node(Vec3::Zero(), draw_radius());
    constexpr int kMostTries = 200;
    int tries = 0;
    while (network_.segment.size() < n_segment) {
      if (uniform() < 0.15 ? close_loop() : branch()) {
        tries = 0;
      } else if (++tries > kMostTries) {  // full: begin elsewhere
        tries = 0;
        add_node(Vec3(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5) * extent(), draw_radius());
      }
    }
    return network_;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>()(random_); }
  double draw_radius() { return thinnest_ * std::pow(thickest_ / thinnest_, uniform()); }
  double extent() const { return 20 * thickest_ * std::cbrt(network_.node.size() + 1.0); }

  int add_node(const Vec3& x, double r) {
    network_.node.push_back(x);
    radius_.push_back(r);
    return static_cast<int>(radius_.size()) - 1;
  }

  bool branch() {
    const auto n = static_cast<double>(radius_.size());
    const int from = uniform() < 0.6 ? static_cast<int>(n) - 1 : static_cast<int>(n * uniform());
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    const double r = draw_radius();
    const double length = (3 + 6 * uniform()) * std::max(r, radius_[from]);
    const Vec3 to = network_.node[from] + length * Vec3(x, y, z).normalized();
    if (!is_free(network_.node[from], to, radius_[from], r, from, -1)) return false;
    add_segment(from, add_node(to, r));
    return true;
  }

  bool close_loop() {
    const auto n = static_cast<double>(radius_.size());
    const int a = static_cast<int>(n * uniform()), b = static_cast<int>(n * uniform());
    const double length = (network_.node[a] - network_.node[b]).norm();
    if (a == b || length > 15 * thickest_ || length < 3 * std::max(radius_[a], radius_[b]))
      return false;
    if (!is_free(network_.node[a], network_.node[b], radius_[a], radius_[b], a, b)) return false;
    add_segment(a, b);
    return true;
  }

  void add_segment(int a, int b) {
    network_.segment.push_back({a, b});
    network_.radius.push_back({radius_[a], radius_[b]});
  }

  /// True if a segment is clear of all others and leaves its nodes in a direction of its own.
  bool is_free(const Vec3& a, const Vec3& b, double ra, double rb, int node_a, int node_b) const {
    constexpr int kPlaces = 40;
    constexpr double kGap = 0.4, kMostAlike = 0.5;
    for (std::size_t s = 0; s < network_.segment.size(); ++s) {
      const auto [p, q] = network_.segment[s];
      std::vector<Vec3> shared;
      for (const auto& [own, other, own_end] : {std::tuple(node_a, b, a), std::tuple(node_b, a, b)})
        for (const auto& [end, far] : {std::pair(p, q), std::pair(q, p)})
          if (end == own) {
            shared.push_back(own_end);
            const Vec3 out = (other - own_end).normalized();
            if ((network_.node[far] - own_end).normalized().dot(out) > kMostAlike) return false;
          }
      for (int k = 0; k <= kPlaces; ++k) {
        const double t = static_cast<double>(k) / kPlaces;
        const Vec3 x = a + t * (b - a);
        const double r = ra + t * (rb - ra);
        const geometry::NearestBall ball = geometry::find_nearest_ball(
            x, network_.node[p], network_.node[q], network_.radius[s][0], network_.radius[s][1]);
        const double gap = ball.apart.norm() - ball.radius - r;
        if (gap >= kGap * thinnest_) continue;
        // Next to a common node they overlap; farther along they must have come apart, at the other
        // end as well.
        const double joined = 3 * std::max({ra, rb, ball.radius});
        if (std::ranges::none_of(shared,
                                 [&](const Vec3& end) { return (x - end).norm() <= joined; }))
          return false;
      }
    }
    return true;
  }

  std::mt19937_64 random_;
  double thinnest_, thickest_;
  geometry::Network network_;
  std::vector<double> radius_;  ///< [node]
};

/// Volume of the union by random points in the boxes of the segments, each point counted once; and
/// its standard deviation.
struct UnionVolume {
  double volume = 0, deviation = 0;
};
inline UnionVolume sample_union(const geometry::Network& n, int per_segment, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  UnionVolume out;
  const auto box_of = [&](std::size_t s, Vec3& low, Vec3& high) {
    low = Vec3::Constant(1e300), high = -low;
    for (const std::size_t end : {0, 1}) {
      const Vec3& x = n.node[n.segment[s][end]];
      low = low.cwiseMin(x - Vec3::Constant(n.radius[s][end]));
      high = high.cwiseMax(x + Vec3::Constant(n.radius[s][end]));
    }
  };
  double variance = 0;
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    Vec3 low, high;
    box_of(s, low, high);
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < n.segment.size(); ++k) {
      Vec3 l, h;
      box_of(k, l, h);
      if ((l.array() <= high.array()).all() && (h.array() >= low.array()).all()) near.push_back(k);
    }
    const double box = (high - low).prod();
    double sum = 0, sum2 = 0;
    for (int i = 0; i < per_segment; ++i) {
      const double u = uniform(random), v = uniform(random), w = uniform(random);
      const Vec3 x = low + Vec3(u, v, w).cwiseProduct(high - low);
      int owners = 0;
      bool own = false;
      for (const std::size_t k : near) {
        const geometry::NearestBall ball = geometry::find_nearest_ball(
            x, n.node[n.segment[k][0]], n.node[n.segment[k][1]], n.radius[k][0], n.radius[k][1]);
        if (ball.apart.norm() >= ball.radius) continue;
        ++owners;
        own = own || k == s;
      }
      const double share = own ? 1.0 / owners : 0;
      sum += share;
      sum2 += share * share;
    }
    const double mean = sum / per_segment;
    out.volume += box * mean;
    variance += box * box * (sum2 / per_segment - mean * mean) / per_segment;
  }
  out.deviation = std::sqrt(variance);
  return out;
}

}  // namespace acinus::geometry
