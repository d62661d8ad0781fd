#pragma once
/// Small surfaces for the mesh tests.

#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::geometry {

/// Box from the origin to `size`, 8 nodes, 12 outward triangles.
inline Surface make_box(const Vec3& size) {
  Surface out;
  for (int i = 0; i < 8; ++i) {
    out.node.push_back(size.cwiseProduct(Vec3(i & 1, i >> 1 & 1, i >> 2 & 1)));
  }
  out.triangle = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return out;
}

/// Ring of n x n quads cut in two: closed, genus 1.
inline Surface make_torus(int n) {
  Surface out;
  const auto index = [n](int i, int j) { return (i % n) * n + j % n; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2 * kPi * i / n, v = 2 * kPi * j / n;
      const double r = 3 + std::cos(v);
      out.node.push_back(Vec3(r * std::cos(u), r * std::sin(u), std::sin(v)));
      out.triangle.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      out.triangle.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return out;
}

/// Icosphere nodes on the sphere of radius R (not inflated), moved by `centre`.
inline Surface make_sphere(int n_node, double radius, const Vec3& centre = Vec3::Zero()) {
  const Topology& topology = shared_icosphere(n_node);
  Surface out;
  for (const Vec3& x : topology.rest) out.node.push_back(centre + radius * x.normalized());
  out.triangle = topology.triangle;
  return out;
}

}  // namespace acinus::geometry
