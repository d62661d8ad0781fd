#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "core/error.hpp"
#include "core/mesh/topology.hpp"

namespace acinus::mesh {

namespace {

constexpr std::array<int, 5> kNodeCounts = {12, 42, 162, 642, 2562};

int level_of(int n_node) {
  const auto found = std::find(kNodeCounts.begin(), kNodeCounts.end(), n_node);
  check(
      found != kNodeCounts.end(),
      fmt::format("an icosphere of {} nodes does not exist; allowed are 12, 42, 162, 642 and 2562.",
                  n_node));
  return static_cast<int>(found - kNodeCounts.begin());
}

// The cyclic permutations of (0, +-1, +-golden ratio): nearest neighbours are 2 apart, and any
// three nodes that are all nearest neighbours are a face.
Surface make_icosahedron() {
  Surface out;
  const double golden = (1 + std::sqrt(5.0)) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double phi : {-golden, golden}) {
        Vec3 x = Vec3::Zero();
        x[(axis + 1) % 3] = one;
        x[(axis + 2) % 3] = phi;
        out.node.push_back(x);
      }
    }
  }
  const auto near = [&](std::size_t i, std::size_t j) {
    return (out.node[i] - out.node[j]).norm() < 2.1;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const bool outward = out.node[i].dot(out.node[j].cross(out.node[k])) > 0;
        const int a = static_cast<int>(i), b = static_cast<int>(j), c = static_cast<int>(k);
        out.triangle.push_back(outward ? std::array{a, b, c} : std::array{a, c, b});
      }
    }
  }
  for (Vec3& x : out.node) x.normalize();
  return out;
}

Surface subdivide(const Surface& coarse) {
  Surface out;
  out.node = coarse.node;
  std::map<std::array<int, 2>, int> middle;
  const auto midpoint = [&](int i, int j) {
    const auto [entry, is_new] =
        middle.try_emplace({std::min(i, j), std::max(i, j)}, static_cast<int>(out.node.size()));
    if (is_new) {
      const Vec3 x = out.node[entry->first[0]] + out.node[entry->first[1]];
      out.node.push_back(x.normalized());
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangle) {
    const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    out.triangle.insert(out.triangle.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return out;
}

// Subdivision scatters neighbours over the whole array. Renumbering breadth-first from node 0
// (Cuthill-McKee) keeps them within one front, so that edge and triangle sweeps stay in cache.
Surface order_breadth_first(const Surface& in) {
  std::vector<std::vector<int>> ring(in.node.size());
  for (const auto& triangle : in.triangle) {
    for (std::size_t k = 0; k < 3; ++k) ring[triangle[k]].push_back(triangle[(k + 1) % 3]);
  }
  std::vector<int> rank(in.node.size(), -1), queue = {0};
  rank[0] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const int next : ring[queue[head]]) {
      if (rank[next] >= 0) continue;
      rank[next] = static_cast<int>(queue.size());
      queue.push_back(next);
    }
  }
  Surface out;
  for (const int old : queue) out.node.push_back(in.node[old]);
  for (auto triangle : in.triangle) {
    for (int& node : triangle) node = rank[node];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    out.triangle.push_back(triangle);
  }
  std::sort(out.triangle.begin(), out.triangle.end());
  return out;
}

}  // namespace

Topology make_icosphere(int n_node) {
  Surface surface = make_icosahedron();
  for (int level = level_of(n_node); level > 0; --level) surface = subdivide(surface);
  return make_topology(order_breadth_first(surface));
}

const Topology& shared_icosphere(int n_node) {
  static std::array<std::optional<Topology>, kNodeCounts.size()> kept;
  static std::array<std::once_flag, kNodeCounts.size()> made;
  const std::size_t level = level_of(n_node);
  std::call_once(made[level], [&] { kept[level] = make_icosphere(n_node); });
  return *kept[level];
}

}  // namespace acinus::mesh
