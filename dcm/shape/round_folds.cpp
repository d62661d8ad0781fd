#include "dcm/shape/round_folds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace acinus::dcm {
namespace {

constexpr int kMostRoundings = 30;
/// Share of the distance to the mean of its neighbours that a node moves in a sweep.
constexpr double kShare = 0.3;

Vec3 area_vector(const geometry::Topology& t, std::span<const Vec3> node, int triangle) {
  const auto at = [&](int i) -> const Vec3& { return node[i]; };
  const auto& [a, b, c] = t.triangle[triangle];
  return 0.5 * (at(b) - at(a)).cross(at(c) - at(a));
}

Vec3 mean_of_neighbours(const geometry::Topology& t, std::span<const Vec3> node, std::size_t i) {
  Vec3 sum = Vec3::Zero();
  for (int k = t.ring_start[i]; k < t.ring_start[i + 1]; ++k) sum += node[t.ring[k]];
  return sum / (t.ring_start[i + 1] - t.ring_start[i]);
}

/// [n_node] 1: at the end of an edge that is too sharp; empty: there is none.
std::vector<std::uint8_t> find_sharp_nodes(const geometry::Topology& t, double least_radius,
                                           std::span<const Vec3> node) {
  std::vector<std::uint8_t> sharp;
  for (int e = 0; e < t.n_edge; ++e) {
    if (fold_radius(t, node, e) >= least_radius) continue;
    sharp.resize(node.size(), 0);
    for (const int i : t.edge[e]) sharp[i] = 1;
  }
  return sharp;
}

}  // namespace

double fold_radius(const geometry::Topology& t, std::span<const Vec3> node, int edge) {
  const std::size_t e = edge;
  const Vec3 a = area_vector(t, node, t.edge_triangle[e][0]),
             b = area_vector(t, node, t.edge_triangle[e][1]);
  const double length = (node[t.edge[e][1]] - node[t.edge[e][0]]).norm();
  // A centroid is a third of its triangle's height off the edge.
  const double width = 2 * (a.norm() + b.norm()) / (3 * length);
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return angle > 0 ? width / angle : std::numeric_limits<double>::infinity();
}

void round_folds(const geometry::Topology& t, double least_radius, std::span<Vec3> node) {
  std::vector<Vec3> moved(node.begin(), node.end());
  for (int sweep = 0; sweep < kMostRoundings; ++sweep) {
    const std::vector<std::uint8_t> sharp = find_sharp_nodes(t, least_radius, node);
    if (sharp.empty()) return;
    for (std::size_t i = 0; i < node.size(); ++i)
      if (sharp[i] != 0) moved[i] += kShare * (mean_of_neighbours(t, node, i) - node[i]);
    std::copy(moved.begin(), moved.end(), node.begin());
  }
}

}  // namespace acinus::dcm
