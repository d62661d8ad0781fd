#pragma once
/// Signed distance to a closed surface by trying everything, written without geometry.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/vec.hpp"

namespace acinus::reference {

inline double plain_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Distance to a triangle: to its plane if the foot lies inside, else to the nearest edge.
inline double plain_distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                         const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const double height = (p - a).dot(n);
  const Vec3 foot = p - height * n;
  const bool inside = (b - a).cross(foot - a).dot(n) >= 0 && (c - b).cross(foot - b).dot(n) >= 0 &&
                      (a - c).cross(foot - c).dot(n) >= 0;
  if (inside) return std::abs(height);
  return std::min({plain_distance_to_segment(p, a, b), plain_distance_to_segment(p, b, c),
                   plain_distance_to_segment(p, c, a)});
}

/// True if a ray from p crosses the surface an odd number of times. Its direction is along no axis:
/// a ray through an edge would be counted twice.
inline bool plain_inside(const Vec3& p, std::span<const Vec3> node,
                         std::span<const std::array<int, 3>> triangle) {
  const Vec3 ray(0.61803398875, 0.41421356237, 0.66913060636);
  int crossings = 0;
  for (const auto& t : triangle) {
    Mat3 m;
    const Vec3& a = node[t[0]];
    m << node[t[1]] - a, node[t[2]] - a, -ray;
    if (std::abs(m.determinant()) < 1e-14) continue;
    const Vec3 s = m.inverse() * (p - a);
    if (s.x() >= 0 && s.y() >= 0 && s.x() + s.y() <= 1 && s.z() > 0) ++crossings;
  }
  return crossings % 2 == 1;
}

inline double plain_signed_distance(const Vec3& p, std::span<const Vec3> node,
                                    std::span<const std::array<int, 3>> triangle) {
  double best = 1e300;
  for (const auto& t : triangle)
    best = std::min(best, plain_distance_to_triangle(p, node[t[0]], node[t[1]], node[t[2]]));
  return plain_inside(p, node, triangle) ? -best : best;
}

}  // namespace acinus::reference
