#include "geometry/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "core/box.hpp"
#include "core/parallel/disjoint_sets.hpp"
#include "geometry/closed.hpp"
#include "geometry/components.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {
namespace {

using Triangle = std::array<int, 3>;

/// Pairs of triangles at an edge that bound the same solid; empty where their directions do not
/// alternate round the edge. @param outward  the normals point out of the solids
std::vector<std::array<int, 2>> pair_round_edge(std::span<const HalfEdge> half,
                                                const std::vector<Vec3>& node, bool outward) {
  constexpr double kSame = 1e-6;  // radians: walls of two bodies that lie upon each other
  const Vec3 low = node[half[0].low];
  const Vec3 axis = (node[half[0].high] - low).normalized();
  const auto across = [&](const HalfEdge& h) {
    const Vec3 r = node[h.opposite] - low;
    return Vec3(r - r.dot(axis) * axis);
  };
  const Vec3 u = across(half[0]).normalized(), v = axis.cross(u);
  if (!u.allFinite() || !axis.allFinite()) return {};
  struct EdgeSide {
    double angle = 0;
    bool ends = false;  ///< the solid lies at lower angles
    int triangle = 0;
  };
  std::vector<EdgeSide> side;
  for (const HalfEdge& h : half) {
    const Vec3 r = across(h);
    double angle = std::atan2(r.dot(v), r.dot(u));
    if (angle < -kSame) angle += 2 * std::numbers::pi;
    side.push_back({angle, h.forward == outward, h.triangle});
  }
  std::ranges::stable_sort(side, {}, &EdgeSide::angle);
  for (std::size_t begin = 0, end = 0; begin < side.size(); begin = end) {
    while (end < side.size() && side[end].angle - side[begin].angle <= kSame) ++end;
    std::stable_partition(side.begin() + static_cast<std::ptrdiff_t>(begin),
                          side.begin() + static_cast<std::ptrdiff_t>(end),
                          [](const EdgeSide& s) { return s.ends; });
  }
  if (side[0].ends) std::rotate(side.begin(), side.begin() + 1, side.end());
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t k = 0; k + 1 < side.size(); k += 2) {
    if (side[k].ends || !side[k + 1].ends) return {};
    pairs.push_back({side[k].triangle, side[k + 1].triangle});
  }
  return 2 * pairs.size() == side.size() ? pairs : std::vector<std::array<int, 2>>{};
}

struct EdgePart {
  std::vector<int> triangle;  ///< ascending
  bool closed = true;
};

/// Parts of some triangles that are connected by edges, ordered by their first triangle.
std::vector<EdgePart> split_at_edges(const Surface& surface, const std::vector<int>& some) {
  std::vector<Triangle> triangle;
  for (const int t : some) triangle.push_back(surface.triangle[t]);
  const std::vector<HalfEdge> half = make_half_edges(triangle);
  const bool outward = compute_volume(surface.node, triangle) >= 0;
  DisjointSets sets(triangle.size());
  std::vector<int> open;
  for (std::size_t begin = 0, end = 0; begin < half.size(); begin = end) {
    while (end < half.size() && half[end].low == half[begin].low &&
           half[end].high == half[begin].high)
      ++end;
    const std::span edge(&half[begin], end - begin);
    if (edge.size() > 2) {
      const auto pairs = pair_round_edge(edge, surface.node, outward);
      for (const auto& [a, b] : pairs) sets.join(a, b);
      if (!pairs.empty()) continue;
    }
    if (edge.size() != 2) open.push_back(edge[0].triangle);
    for (const HalfEdge& h : edge) sets.join(edge[0].triangle, h.triangle);
  }
  std::map<int, std::size_t> number;
  std::vector<EdgePart> pieces;
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const auto [entry, is_new] = number.try_emplace(sets.find(static_cast<int>(t)), pieces.size());
    if (is_new) pieces.emplace_back();
    pieces[entry->second].triangle.push_back(some[t]);
  }
  for (const int t : open) pieces[number.at(sets.find(t))].closed = false;
  return pieces;
}

/// Merges nodes of the given triangles that have the same position.
/// @return true if there were any
bool join_by_place(const std::vector<int>& some, Surface& surface) {
  std::map<std::array<double, 3>, int> first;
  bool any = false;
  for (const int t : some)
    for (int& node : surface.triangle[t]) {
      const Vec3& x = surface.node[node];
      // + 0.0 turns -0 into 0
      const auto entry =
          first.try_emplace({x[0] + 0.0, x[1] + 0.0, x[2] + 0.0}, node).first->second;
      any = any || entry != node;
      node = entry;
    }
  return any;
}

Box box_of(const Surface& s) {
  Box box;
  for (const Vec3& x : s.node) box.include(x);
  return box;
}

/// True for a point inside a closed surface, by the solid angle of its triangles. [VanOosterom1983]
bool encloses(const Surface& s, const Vec3& x) {
  double sum = 0;
  for (const auto& [i, j, k] : s.triangle) {
    const Vec3 a = s.node[i] - x, b = s.node[j] - x, c = s.node[k] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(sum) > 2 * std::numbers::pi;
}

}  // namespace

std::vector<Surface> split_bodies(const Soup& soup) {
  std::map<int, std::vector<int>> by_group;
  for (std::size_t t = 0; t < soup.surface.triangle.size(); ++t)
    by_group[soup.group.empty() ? 0 : soup.group[t]].push_back(static_cast<int>(t));
  std::vector<EdgePart> pieces;
  std::vector<int> open;
  for (const auto& [group, triangles] : by_group)
    for (EdgePart& p : split_at_edges(soup.surface, triangles)) {
      if (!p.closed) open.insert(open.end(), p.triangle.begin(), p.triangle.end());
      pieces.push_back(std::move(p));
    }
  Surface joined = soup.surface;
  std::ranges::sort(open);
  if (!open.empty() && (join_by_place(open, joined) || by_group.size() > 1)) {
    std::erase_if(pieces, [](const EdgePart& p) { return !p.closed; });
    for (EdgePart& p : split_at_edges(joined, open)) pieces.push_back(std::move(p));
  }
  std::ranges::sort(pieces, {}, [](const EdgePart& p) { return p.triangle.front(); });
  std::vector<Surface> bodies;
  for (const EdgePart& p : pieces) {
    std::vector<Triangle> triangle;
    for (const int t : p.triangle) triangle.push_back(joined.triangle[t]);
    bodies.push_back(compacted(joined.node, std::move(triangle)));
  }
  return bodies;
}

Nested find_nested(const std::vector<Surface>& bodies) {
  std::vector<Box> box;
  for (const Surface& s : bodies) box.push_back(box_of(s));
  std::vector<int> order(bodies.size());
  std::iota(order.begin(), order.end(), 0);
  const auto low = [&](int b) { return box[b].low[0]; };
  std::ranges::sort(order, {}, low);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t a = order[i];
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) < box[a].high[0]; ++j) {
      const std::size_t b = order[j];
      const bool inside = (box[b].low.array() > box[a].low.array()).all() &&
                          (box[b].high.array() < box[a].high.array()).all();
      if (inside && encloses(bodies[a], bodies[b].node.front())) return {order[j], order[i]};
    }
  }
  return {};
}

}  // namespace acinus::geometry
