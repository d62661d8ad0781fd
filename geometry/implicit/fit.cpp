#include "geometry/implicit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel/threads.hpp"

namespace acinus::geometry {
namespace {

constexpr int kFitRounds = 2, kSmooth = 3;

/// Means of a function over the triangles, exact for quadratic ones: from corners and centre.
std::vector<double> means_over(const Distance& distance, const geometry::Surface& s) {
  std::vector<double> at_node(s.node.size()), mean(s.triangle.size());
  for_each_index(s.node.size(), true, [&](std::size_t k) { at_node[k] = distance(s.node[k]); });
  for_each_index(s.triangle.size(), true, [&](std::size_t t) {
    const auto& [a, b, c] = s.triangle[t];
    const double center = distance((s.node[a] + s.node[b] + s.node[c]) / 3);
    mean[t] = 0.75 * center + (at_node[a] + at_node[b] + at_node[c]) / 12;
  });
  return mean;
}

/// Sums over the triangles about a node: normals, the function's means and areas.
using NodeSums = Eigen::Matrix<double, 5, 1>;

/// Replaces the sums at nodes by their means over the triangles about each, `times` times.
void smooth(const geometry::Surface& s, int times, std::vector<NodeSums>& value) {
  std::vector<int> about(value.size(), 0);
  for (const auto& corner : s.triangle)
    for (const int k : corner) ++about[k];
  std::vector<NodeSums> sum(value.size());
  for (; times > 0; --times) {
    std::ranges::fill(sum, NodeSums::Zero());
    for (const auto& [a, b, c] : s.triangle) {
      const NodeSums mean = (value[a] + value[b] + value[c]) / 3;
      for (const int k : {a, b, c}) sum[k] += mean;
    }
    for (std::size_t k = 0; k < value.size(); ++k)
      if (about[k] > 0) value[k] = sum[k] / about[k];
  }
}

/// Displacement of a node along its normal that brings the function nearer to zero.
struct FitMove {
  Vec3 normal = Vec3::Zero();  ///< unit; zero: node of no triangle
  double distance = 0;         ///< um
  double edge = 0;             ///< um, mean about it
};

std::vector<FitMove> find_moves(const Distance& distance, const geometry::Surface& s) {
  const std::vector<double> mean = means_over(distance, s);
  std::vector<NodeSums> sum(s.node.size(), NodeSums::Zero());
  for (std::size_t t = 0; t < s.triangle.size(); ++t) {
    const auto& [a, b, c] = s.triangle[t];
    const Vec3 n = (s.node[b] - s.node[a]).cross(s.node[c] - s.node[a]);
    NodeSums of;
    of << n, n.norm() * mean[t], n.norm();
    for (const int k : {a, b, c}) sum[k] += of;
  }
  // Slivers would cross each other if each node went its own way: neighbours go together.
  smooth(s, kSmooth, sum);
  std::vector<FitMove> move(s.node.size());
  for (std::size_t k = 0; k < s.node.size(); ++k) {
    const double area = sum[k][4];
    if (area > 0) move[k] = {sum[k].head<3>().normalized(), -sum[k][3] / area, std::sqrt(area)};
  }
  return move;
}

}  // namespace

void fit(const Distance& distance, double most, geometry::Surface& s) {
  if (s.node.empty()) return;
  for (int round = 0; round < kFitRounds; ++round) {
    const std::vector<FitMove> move = find_moves(distance, s);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      const double farthest = most * move[k].edge;
      s.node[k] += std::clamp(move[k].distance, -farthest, farthest) * move[k].normal;
    }
  }
}

void fit(const Distance& distance, ZeroSurface& z) {
  constexpr double kMostSlanting = 0.2;  // cosine: nodes would go far along such an edge
  if (z.surface.node.empty()) return;
  for (int round = 0; round < kFitRounds; ++round) {
    const std::vector<FitMove> move = find_moves(distance, z.surface);
    for (std::size_t k = 0; k < z.surface.node.size(); ++k) {
      const auto& [a, b] = z.edge[k];
      const Vec3 along = b - a;
      const double length = along.norm(), outward = along.dot(move[k].normal) / length;
      const double at = (z.surface.node[k] - a).norm() / length;
      const double to = at + move[k].distance / (std::max(outward, kMostSlanting) * length);
      z.surface.node[k] = a + std::clamp(to, kEdgeEnd, 1 - kEdgeEnd) * along;
    }
  }
}

}  // namespace acinus::geometry
