#pragma once
/// View of one group of eight cells, the input of the term kernels.

#include "core/numbers/lanes.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

struct GroupView {
  const geometry::Topology* topology;
  std::size_t index;      ///< group number
  std::size_t first_row;  ///< first point row in the global arrays
  /// First elements in the global arrays.
  std::size_t first_shape, first_spring, first_hinge, first_face;
  const double* position;  ///< [n_node][3][lane] um
  const double* radius;    ///< [lane] um, reference radius at the end of the step
  const double* area;      ///< [lane] reference surface over that of a sphere (BirthShape)
  const double* edge;      ///< [n_edge][lane] reference lengths, likewise; null: all 1
  const double* triangle;  ///< [n_triangle][lane] reference areas, likewise; null: all 1
  const double* tension;   ///< [n_edge][lane] nN (EdgeTension) at the start of the step; null: none
  const double* length;    ///< [n_edge][lane] um, likewise
  const double* active;    ///< [lane] 1 where a cell is, 0 in empty lanes
};

/// Rest area of one cell at the end of the step, um^2.
inline double rest_area(const GroupView& g, int lane) {
  return g.topology->rest_area * g.radius[lane] * g.radius[lane] * g.area[lane];
}
inline double rest_length(const GroupView& g, std::size_t edge, int lane) {
  const double ratio = g.edge ? g.edge[edge * kLanes + lane] : 1;
  return g.topology->rest_length[edge] * g.radius[lane] * ratio;
}
inline double rest_triangle_area(const GroupView& g, std::size_t triangle, int lane) {
  const double ratio = g.triangle ? g.triangle[triangle * kLanes + lane] : 1;
  return g.topology->rest_triangle_area[triangle] * g.radius[lane] * g.radius[lane] * ratio;
}

/// Present area of a triangle, um^2.
inline double triangle_area(const GroupView& g, std::size_t triangle, int lane) {
  const auto node = [&](int corner) { return load_point(g.position, make_address(corner, lane)); };
  const auto& [a, b, c] = g.topology->triangle[triangle];
  return 0.5 * (node(b) - node(a)).cross(node(c) - node(a)).norm();
}

}  // namespace acinus::dcm
