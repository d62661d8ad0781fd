#include "core/implicit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/threads.hpp"

namespace acinus::implicit {
namespace {

constexpr int kRounds = 2, kSmooth = 3;

/// Mean of a function over a triangle, exact for cubic ones: corners, midpoints, centre.
double mean_over(const Distance& distance, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double corners = distance(a) + distance(b) + distance(c);
  const double sides = distance(0.5 * (a + b)) + distance(0.5 * (b + c)) + distance(0.5 * (c + a));
  return (3 * corners + 8 * sides + 27 * distance((a + b + c) / 3)) / 60;
}

/// Replaces values of nodes by their mean over the triangles about each, as often as said.
template <class T>
void smooth(const mesh::Surface& s, int times, std::vector<T>& value) {
  for (; times > 0; --times) {
    std::vector<T> sum(value.size(), 0 * value[0]);
    std::vector<int> about(value.size(), 0);
    for (const auto& corner : s.triangle) {
      const T mean = (value[corner[0]] + value[corner[1]] + value[corner[2]]) / 3;
      for (const int k : corner) {
        sum[k] += mean;
        ++about[k];
      }
    }
    for (std::size_t k = 0; k < value.size(); ++k)
      if (about[k] > 0) value[k] = sum[k] / about[k];
  }
}

}  // namespace

void fit(const Distance& distance, double most, mesh::Surface& s) {
  if (s.node.empty()) return;
  std::vector<double> mean(s.triangle.size());
  for (int round = 0; round < kRounds; ++round) {
    for_each_index(s.triangle.size(), true, [&](std::size_t t) {
      const auto& [a, b, c] = s.triangle[t];
      mean[t] = mean_over(distance, s.node[a], s.node[b], s.node[c]);
    });
    std::vector<Vec3> normal(s.node.size(), Vec3::Zero());
    std::vector<double> sum(s.node.size(), 0.0), area(s.node.size(), 0.0);
    for (std::size_t t = 0; t < s.triangle.size(); ++t) {
      const auto& [a, b, c] = s.triangle[t];
      const Vec3 n = (s.node[b] - s.node[a]).cross(s.node[c] - s.node[a]);
      for (const int k : s.triangle[t]) {
        normal[k] += n;
        sum[k] += n.norm() * mean[t];
        area[k] += n.norm();
      }
    }
    // Slivers would cross each other if each node went its own way: neighbours go together.
    smooth(s, kSmooth, sum);
    smooth(s, kSmooth, area);
    smooth(s, kSmooth, normal);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      if (!(area[k] > 0)) continue;
      const double farthest = most * std::sqrt(area[k]);
      s.node[k] -= std::clamp(sum[k] / area[k], -farthest, farthest) * normal[k].normalized();
    }
  }
}

}  // namespace acinus::implicit
