#pragma once
/// Box of triangles, to test closed surfaces with.

#include <array>

#include "geometry/surface.hpp"

namespace acinus::reference {

/// Box with corners low and high, 12 triangles.
inline geometry::Surface brick(const Vec3& low, const Vec3& high) {
  geometry::Surface out;
  for (int i = 0; i < 8; ++i)
    out.node.emplace_back((i & 1 ? high : low).x(), (i & 2 ? high : low).y(),
                          (i & 4 ? high : low).z());
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    out.triangle.push_back({a, b, c});
    out.triangle.push_back({a, c, d});
  }
  return out;
}

}  // namespace acinus::reference
