#pragma once
/// Connectivity and rest shape of one closed cell mesh, shared by every cell that uses it.

#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Topology of a cell mesh, immutable after make_topology. All rest quantities are for the unit
/// cell: the rest shape is scaled so that its volume is exactly 4/3 pi, so a cell of radius R = (3
/// V0 / 4 pi)^(1/3) has rest lengths R * rest_length, areas R^2 * rest_area and volume R^3 * 4/3
/// pi.
struct Topology {
  int n_node = 0;
  int n_edge = 0;
  int n_triangle = 0;
  std::vector<Vec3> rest;                    ///< [n_node] centred on the volume centroid
  std::vector<std::array<int, 3>> triangle;  ///< [n_triangle] outward orientation
  std::vector<std::array<int, 2>> edge;      ///< [n_edge] i < j
  /// [n_edge] {x1, x2, x3, x4}: hinge about the edge x3-x4 with opposite corners x1, x2, oriented
  /// so that N1 = (x1-x3)x(x1-x4) and N2 = (x2-x4)x(x2-x3) both point outward on the rest shape.
  std::vector<std::array<int, 4>> hinge;
  std::vector<std::array<int, 2>> edge_triangle;  ///< [n_edge] the two triangles (with x1, with x2)
  std::vector<double> rest_length;                ///< [n_edge]
  /// [n_edge] cos and sin of the signed rest angle theta = -atan2((N1 x N2).e, N1.N2), e =
  /// (x4-x3)/|x4-x3|
  std::vector<double> rest_angle_cos, rest_angle_sin;
  std::vector<double> rest_triangle_area;  ///< [n_triangle]
  std::vector<double>
      rest_node_area;  ///< [n_node] one third of the adjacent triangles; sums to rest_area
  double rest_area = 0;
  double mean_rest_length = 0;
  std::vector<int> ring_start, ring;  ///< CSR: sorted one-ring neighbours of each node
  std::vector<int> node_triangle_start, node_triangle;  ///< CSR: triangles around each node
};

/// Builds the topology of a closed, oriented, connected manifold surface of genus 0.
/// Throws Error naming the offending edge or node if it is not closed, manifold, oriented, or
/// connected.
Topology make_topology(const Surface& surface);

/// Icosphere with 12, 42, 92, 162, 252, 362, 642, 1442 or 2562 nodes. Throws Error for another
/// count.
Topology make_icosphere(int n_node);

/// Icosphere made once and kept for the life of the program.
const Topology& shared_icosphere(int n_node);

}  // namespace acinus::geometry
