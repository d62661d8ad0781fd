#pragma once
/// All quadratures of contact, and what area their points stand for.

#include <algorithm>
#include <array>

#include "contact/surface.hpp"

namespace acinus::dcm {

inline constexpr contact::Quadrature kAll[] = {contact::Quadrature::kThreePoint,
                                               contact::Quadrature::kNodes,
                                               contact::Quadrature::kNodesAndEdges};

/// Area of a point on the rest shape: what every triangle gives it.
inline double rest_share(const geometry::Topology& t, contact::Quadrature q, int point) {
  if (q == contact::Quadrature::kThreePoint) return t.rest_triangle_area[point / 3] / 3;
  const bool both = q == contact::Quadrature::kNodesAndEdges;
  double area = 0;
  for (std::size_t k = 0; k < t.triangle.size(); ++k)
    for (std::size_t m = 0; m < 3; ++m) {
      const int i = t.triangle[k][m], j = t.triangle[k][(m + 1) % 3];
      const std::array<int, 2> edge{std::min(i, j), std::max(i, j)};
      if (i == point) area += (both ? 1.0 / 12 : 1.0 / 3) * t.rest_triangle_area[k];
      if (point >= t.n_node && edge == t.edge[point - t.n_node])
        area += t.rest_triangle_area[k] / 4;
    }
  return area;
}

}  // namespace acinus::dcm
