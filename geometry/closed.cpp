#include "geometry/closed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/error.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {

namespace {

std::string text(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

std::string edge_text(const Surface& surface, const HalfEdge& edge) {
  return fmt::format("edge {}-{} from {} to {} um", edge.low, edge.high,
                     text(surface.node[edge.low]), text(surface.node[edge.high]));
}

void check_corners(const Surface& surface, const std::string& where) {
  const int n_node = static_cast<int>(surface.node.size());
  check(!surface.triangle.empty(), where + ": the surface has no triangles.");
  check(std::ssize(surface.triangle) <= std::numeric_limits<int>::max() / 3,
        where + ": the surface has too many triangles.");
  for (std::size_t t = 0; t < surface.triangle.size(); ++t) {
    const auto& [a, b, c] = surface.triangle[t];
    check(std::min({a, b, c}) >= 0 && std::max({a, b, c}) < n_node,
          fmt::format("{}: triangle {} uses nodes {}, {}, {}, but there are {} nodes.", where, t, a,
                      b, c, n_node));
    check(a != b && b != c && c != a,
          fmt::format("{}: triangle {} uses a node twice ({}, {}, {}). Remove collapsed triangles.",
                      where, t, a, b, c));
  }
}

void check_edges(const Surface& surface, const std::string& where) {
  const std::vector<HalfEdge> half = make_half_edges(surface.triangle);
  std::size_t n_open = 0, n_crowded = 0, n_turned = 0;
  const HalfEdge* first = nullptr;
  const HalfEdge* first_turned = nullptr;
  for (std::size_t begin = 0, end = 0; begin < half.size(); begin = end) {
    while (end < half.size() && half[end].low == half[begin].low &&
           half[end].high == half[begin].high)
      ++end;
    n_open += end - begin == 1;
    n_crowded += end - begin > 2;
    if (end - begin != 2) {
      if (!first) first = &half[begin];
    } else if (half[begin].forward == half[begin + 1].forward) {
      ++n_turned;
      if (!first_turned) first_turned = &half[begin];
    }
  }
  if (first) {
    throw Error(
        fmt::format("{}: not a closed surface: {} open edges (one triangle) and {} non-manifold "
                    "edges (more than two triangles); first {}. Every edge of a body must join "
                    "exactly two triangles. Close the holes in the program that made the mesh; "
                    "bodies that share a wall need all their faces each, turned outward, in a "
                    "solid, object, group or polyhedron of its own.",
                    where, n_open, n_crowded, edge_text(surface, *first)));
  }
  if (first_turned) {
    throw Error(
        fmt::format("{}: the triangles are not oriented alike: {} edges are run twice in the same "
                    "direction; first {}. "
                    "Neighbouring triangles must all be counter-clockwise seen from one side. "
                    "Reorient the faces in the "
                    "program that made the mesh.",
                    where, n_turned, edge_text(surface, *first_turned)));
  }
}

// Two cones that touch in their tips pass the edge test; walking round each node finds them.
void check_fans(const Surface& surface, const std::string& where) {
  const std::size_t n_node = surface.node.size();
  std::vector<int> start(n_node + 1, 0);
  for (const auto& triangle : surface.triangle) {
    for (const int node : triangle) ++start[node + 1];
  }
  for (std::size_t node = 0; node < n_node; ++node) start[node + 1] += start[node];
  std::vector<std::array<int, 2>> link(surface.triangle.size() *
                                       3);  // per corner: next, previous node
  std::vector<int> filled(start.begin(), start.end() - 1);
  for (const auto& triangle : surface.triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int slot = filled[triangle[k]]++;
      link[slot] = {triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
    }
  }
  for (std::size_t node = 0; node < n_node; ++node) {
    const auto begin = link.begin() + start[node];
    const auto end = link.begin() + start[node + 1];
    std::sort(begin, end);
    int steps = 0;
    for (auto at = begin; at != end;) {
      ++steps;
      at = std::lower_bound(begin, end, std::array<int, 2>{(*at)[1], -1});
      if (at == begin || at == end) break;
    }
    check(steps == end - begin,
          fmt::format("{}: node {} at {} um joins two sheets that touch only there. Every node "
                      "must have one ring "
                      "of triangles. Separate the sheets in the program that made the mesh.",
                      where, node, text(surface.node[node])));
  }
}

}  // namespace

std::vector<HalfEdge> make_half_edges(std::span<const std::array<int, 3>> triangle) {
  std::vector<HalfEdge> half;
  half.reserve(triangle.size() * 3);
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle[t][k];
      const int b = triangle[t][(k + 1) % 3];
      half.push_back(
          {std::min(a, b), std::max(a, b), static_cast<int>(t), triangle[t][(k + 2) % 3], a < b});
    }
  }
  std::sort(half.begin(), half.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tuple(a.low, a.high, !a.forward, a.triangle) <
           std::tuple(b.low, b.high, !b.forward, b.triangle);
  });
  return half;
}

void check_manifold(const Surface& surface, const std::string& where) {
  check_corners(surface, where);
  check_edges(surface, where);
  check_fans(surface, where);
}

void check_closed(Surface& surface, const std::string& where) {
  check_manifold(surface, where);
  const double volume = compute_volume(surface.node, surface.triangle);
  const double area = compute_area(surface.node, surface.triangle);
  // A closed surface of area A has at most the volume of the sphere, A^1.5 / (6 sqrt(pi)).
  check(std::isfinite(volume) && std::abs(volume) > 1e-9 * std::pow(area, 1.5),
        fmt::format("{}: the surface encloses a volume of {:.3g} um^3 with an area of {:.3g} um^2: "
                    "it is flat or "
                    "turned inside out in parts. Check the mesh and its unit.",
                    where, volume, area));
  if (volume > 0) return;
  for (auto& triangle : surface.triangle) std::swap(triangle[1], triangle[2]);
}

}  // namespace acinus::geometry
