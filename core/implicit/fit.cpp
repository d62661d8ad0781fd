#include "core/implicit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/threads.hpp"

namespace acinus::implicit {
namespace {

constexpr int kRounds = 3;

/// Mean of a function over a triangle, exact for cubic ones: corners, midpoints, centre.
double mean_over(const Distance& distance, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double corners = distance(a) + distance(b) + distance(c);
  const double sides = distance(0.5 * (a + b)) + distance(0.5 * (b + c)) + distance(0.5 * (c + a));
  return (3 * corners + 8 * sides + 27 * distance((a + b + c) / 3)) / 60;
}

}  // namespace

void fit(const Distance& distance, double most, mesh::Surface& s) {
  std::vector<double> moved(s.node.size(), 0.0), mean(s.triangle.size());
  for (int round = 0; round < kRounds; ++round) {
    for_each_index(s.triangle.size(), true, [&](std::size_t t) {
      const auto& [a, b, c] = s.triangle[t];
      mean[t] = mean_over(distance, s.node[a], s.node[b], s.node[c]);
    });
    std::vector<Vec3> normal(s.node.size(), Vec3::Zero());
    std::vector<double> sum(s.node.size(), 0.0), area(s.node.size(), 0.0);
    std::vector<int> about(s.node.size(), 0);
    for (std::size_t t = 0; t < s.triangle.size(); ++t) {
      const auto& [a, b, c] = s.triangle[t];
      const Vec3 n = (s.node[b] - s.node[a]).cross(s.node[c] - s.node[a]);
      for (const int k : s.triangle[t]) {
        normal[k] += n;
        sum[k] += n.norm() * mean[t];
        area[k] += n.norm();
        ++about[k];
      }
    }
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      if (!(area[k] > 0)) continue;
      const double farthest = most * std::sqrt(area[k] / about[k]);
      const double to = std::clamp(moved[k] - sum[k] / area[k], -farthest, farthest);
      s.node[k] += (to - moved[k]) * normal[k].normalized();
      moved[k] = to;
    }
  }
}

}  // namespace acinus::implicit
