#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "geometry/topology.hpp"

namespace acinus::geometry {

namespace {

/// Subdivision of the icosahedron: every edge is cut into `parts` at once, then every edge of the
/// result in half, `halvings` times.
struct Recipe {
  int n_node;
  int parts;
  int halvings;
};
constexpr std::array<Recipe, 9> kRecipes{{{12, 1, 0},
                                          {42, 1, 1},
                                          {92, 3, 0},
                                          {162, 1, 2},
                                          {252, 5, 0},
                                          {362, 3, 1},
                                          {642, 1, 3},
                                          {1442, 3, 2},
                                          {2562, 1, 4}}};

std::size_t number_of_recipe(int n_node) {
  const auto found = std::ranges::find(kRecipes, n_node, &Recipe::n_node);
  check(found != kRecipes.end(),
        fmt::format("an icosphere of {} nodes does not exist; allowed are 12, 42, 92, 162, 252, "
                    "362, 642, 1442 and 2562.",
                    n_node));
  return found - kRecipes.begin();
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

/// Subdivides every edge into n parts and every face into n^2.
Surface cut_edges(const Surface& coarse, int n) {
  Surface out;
  std::map<std::array<std::pair<int, int>, 3>, int> known;  // (parts, corner), ascending
  const auto node_at = [&](const std::array<int, 3>& corner, int i, int j) {
    std::array<std::pair<int, int>, 3> key{
        {{n - i - j, corner[0]}, {i, corner[1]}, {j, corner[2]}}};
    for (auto& [parts, at] : key) at = parts > 0 ? at : -1;  // the same from both faces
    std::ranges::sort(key);
    const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(out.node.size()));
    if (is_new) {
      Vec3 x = Vec3::Zero();
      for (const auto& [parts, at] : key)
        if (parts > 0) x += parts * coarse.node[at];
      out.node.push_back(x.normalized());
    }
    return entry->second;
  };
  for (const auto& corner : coarse.triangle)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const int a = node_at(corner, i, j), b = node_at(corner, i + 1, j),
                  c = node_at(corner, i, j + 1);
        out.triangle.push_back({a, b, c});
        if (i + j + 1 < n) out.triangle.push_back({b, node_at(corner, i + 1, j + 1), c});
      }
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
  const Recipe& recipe = kRecipes[number_of_recipe(n_node)];
  Surface surface = make_icosahedron();
  if (recipe.parts > 1) surface = cut_edges(surface, recipe.parts);
  for (int k = 0; k < recipe.halvings; ++k) surface = subdivide(surface);
  return make_topology(order_breadth_first(surface));
}

const Topology& shared_icosphere(int n_node) {
  static std::array<std::optional<Topology>, kRecipes.size()> kept;
  static std::array<std::once_flag, kRecipes.size()> made;
  const std::size_t number = number_of_recipe(n_node);
  std::call_once(made[number], [&] { kept[number] = make_icosphere(n_node); });
  return *kept[number];
}

}  // namespace acinus::geometry
