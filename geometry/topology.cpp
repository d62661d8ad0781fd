#include "geometry/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/closed.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {

namespace {

constexpr const char* kWhere = "cell mesh";

void make_edges(Topology& out) {
  const std::vector<HalfEdge> half = make_half_edges(out.triangle);
  out.n_edge = static_cast<int>(half.size() / 2);
  for (std::size_t e = 0; e < half.size(); e += 2) {
    // The forward side runs x3 -> x4, so (x1-x3)x(x1-x4) points the way its triangle does: outward.
    const HalfEdge& forward = half[e];
    const HalfEdge& backward = half[e + 1];
    out.edge.push_back({forward.low, forward.high});
    out.hinge.push_back({forward.opposite, backward.opposite, forward.low, forward.high});
    out.edge_triangle.push_back({forward.triangle, backward.triangle});
  }
}

void make_rings(Topology& out) {
  const std::size_t n_node = out.n_node;
  std::vector<std::vector<int>> ring(n_node), around(n_node);
  for (const auto& [i, j] : out.edge) {
    ring[i].push_back(j);
    ring[j].push_back(i);
  }
  for (int t = 0; t < out.n_triangle; ++t) {
    for (const int node : out.triangle[t]) {
      around[node].push_back(t);
    }
  }
  out.ring_start = {0};
  out.node_triangle_start = {0};
  for (std::size_t node = 0; node < n_node; ++node) {
    std::sort(ring[node].begin(), ring[node].end());
    out.ring.insert(out.ring.end(), ring[node].begin(), ring[node].end());
    out.ring_start.push_back(static_cast<int>(out.ring.size()));
    out.node_triangle.insert(out.node_triangle.end(), around[node].begin(), around[node].end());
    out.node_triangle_start.push_back(static_cast<int>(out.node_triangle.size()));
  }
}

// One piece without handles: what the cell model, division and ray casting rely on.
void check_sphere_like(const Topology& out) {
  std::vector<char> seen(out.n_node, 0);
  std::vector<int> stack = {0};
  seen[0] = 1;
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    for (int k = out.ring_start[node]; k < out.ring_start[node + 1]; ++k) {
      const int next = out.ring[k];
      if (seen[next]) continue;
      seen[next] = 1;
      stack.push_back(next);
    }
  }
  const auto lost = std::find(seen.begin(), seen.end(), 0);
  check(lost == seen.end(), fmt::format("{}: node {} is not connected to node 0 by edges. A cell "
                                        "is one connected surface: give each "
                                        "body its own mesh and leave out unused nodes.",
                                        kWhere, lost - seen.begin()));
  const int euler = out.n_node - out.n_edge + out.n_triangle;
  check(euler == 2,
        fmt::format(
            "{}: nodes - edges + triangles = {} - {} + {} = {}, but a cell must be a deformed "
            "sphere, where it is 2. Remove its {} handles.",
            kWhere, out.n_node, out.n_edge, out.n_triangle, euler, (2 - euler) / 2));
}

void make_rest_shape(Topology& out, const Surface& surface) {
  for (const Vec3& x : surface.node) {
    check(x.allFinite(), fmt::format("{}: a node has a coordinate that is not finite.", kWhere));
  }
  const double volume = compute_volume(surface.node, surface.triangle);
  check(
      volume > 0,
      fmt::format("{}: the volume is {:.3g}: the triangles point inward or the mesh is flat. Turn "
                  "every triangle so that it is counter-clockwise seen from outside.",
                  kWhere, volume));
  const Vec3 centroid = compute_centroid(surface.node, surface.triangle);
  const double inflate = std::cbrt(4 * kPi / 3 / volume);
  out.rest.reserve(surface.node.size());
  for (const Vec3& x : surface.node) out.rest.push_back(inflate * (x - centroid));
}

void make_rest_measures(Topology& out) {
  const auto x = [&](int node) -> const Vec3& { return out.rest[node]; };
  out.rest_node_area.assign(out.n_node, 0.0);
  for (int t = 0; t < out.n_triangle; ++t) {
    const auto& [a, b, c] = out.triangle[t];
    // Below this the triangle's normal, and with it the rest angles, would be round-off.
    check(compute_triangle_quality(x(a), x(b), x(c)) > 1e-9,
          fmt::format("{}: triangle {} (nodes {}, {}, {}) has no area. Remesh the surface.", kWhere,
                      t, a, b, c));
    const double area = (x(b) - x(a)).cross(x(c) - x(a)).norm() / 2;
    out.rest_triangle_area.push_back(area);
    out.rest_area += area;
    for (const int node : {a, b, c}) out.rest_node_area[node] += area / 3;
  }
  for (const auto& [x1, x2, x3, x4] : out.hinge) {
    const Vec3 edge = x(x4) - x(x3);
    const Vec3 normal_1 = (x(x1) - x(x3)).cross(x(x1) - x(x4));
    const Vec3 normal_2 = (x(x2) - x(x4)).cross(x(x2) - x(x3));
    const double sine = -normal_1.cross(normal_2).dot(edge) / edge.norm();
    const double cosine = normal_1.dot(normal_2);
    const double size = std::hypot(sine, cosine);
    out.rest_length.push_back(edge.norm());
    out.rest_angle_cos.push_back(cosine / size);
    out.rest_angle_sin.push_back(sine / size);
    out.mean_rest_length += edge.norm() / out.n_edge;
  }
}

}  // namespace

Topology make_topology(const Surface& surface) {
  check_manifold(surface, kWhere);
  Topology out;
  out.n_node = static_cast<int>(surface.node.size());
  out.n_triangle = static_cast<int>(surface.triangle.size());
  out.triangle = surface.triangle;
  make_edges(out);
  make_rings(out);
  check_sphere_like(out);
  make_rest_shape(out, surface);
  make_rest_measures(out);
  return out;
}

}  // namespace acinus::geometry
