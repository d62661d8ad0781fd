#include "core/implicit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/threads.hpp"

namespace acinus::implicit {
namespace {

constexpr int kRounds = 2, kSmooth = 3;

/// Means of a function over the triangles, exact for quadratic ones: from corners and centre.
std::vector<double> means_over(const Distance& distance, const mesh::Surface& s) {
  std::vector<double> at_node(s.node.size()), mean(s.triangle.size());
  for_each_index(s.node.size(), true, [&](std::size_t k) { at_node[k] = distance(s.node[k]); });
  for_each_index(s.triangle.size(), true, [&](std::size_t t) {
    const auto& [a, b, c] = s.triangle[t];
    const double center = distance((s.node[a] + s.node[b] + s.node[c]) / 3);
    mean[t] = 0.75 * center + (at_node[a] + at_node[b] + at_node[c]) / 12;
  });
  return mean;
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

/// How far the function wants each node to go, along the normal there.
struct FitMoves {
  std::vector<Vec3> normal;      ///< [node] unit; zero: of no triangle
  std::vector<double> distance;  ///< [node] um
  std::vector<double> edge;      ///< [node] um, mean about it
};

FitMoves find_moves(const Distance& distance, const mesh::Surface& s) {
  const std::vector<double> mean = means_over(distance, s);
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
    sum[k] = area[k] > 0 ? -sum[k] / area[k] : 0;
    area[k] = std::sqrt(area[k]);
    normal[k].normalize();
  }
  return {std::move(normal), std::move(sum), std::move(area)};
}

}  // namespace

void fit(const Distance& distance, double most, mesh::Surface& s) {
  if (s.node.empty()) return;
  for (int round = 0; round < kRounds; ++round) {
    const FitMoves m = find_moves(distance, s);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      const double farthest = most * m.edge[k];
      s.node[k] += std::clamp(m.distance[k], -farthest, farthest) * m.normal[k];
    }
  }
}

void fit(const Distance& distance, ZeroSurface& z) {
  constexpr double kMostSlanting = 0.2;  // cosine: nodes would go far along such an edge
  if (z.surface.node.empty()) return;
  for (int round = 0; round < kRounds; ++round) {
    const FitMoves m = find_moves(distance, z.surface);
    for (std::size_t k = 0; k < z.surface.node.size(); ++k) {
      const auto& [a, b] = z.edge[k];
      const Vec3 along = b - a;
      const double length = along.norm(), outward = along.dot(m.normal[k]) / length;
      const double at = (z.surface.node[k] - a).norm() / length;
      const double to = at + m.distance[k] / (std::max(outward, kMostSlanting) * length);
      z.surface.node[k] = a + std::clamp(to, kEdgeEnd, 1 - kEdgeEnd) * along;
    }
  }
}

}  // namespace acinus::implicit
