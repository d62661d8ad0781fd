#pragma once
/// Triangle surfaces as contact sees them: bodies with normals, and the points that probe them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/box_pairs.hpp"
#include "geometry/topology.hpp"

namespace acinus::contact {

/// Where the gap of a surface is sampled.
enum class Quadrature {
  kThreePoint,    ///< three interior points per triangle, weights (2/3, 1/6, 1/6)
  kNodes,         ///< the nodes
  kNodesAndEdges  ///< the nodes, then the edge midpoints
};

/// A closed surface at one moment. Does not know whether it is a cell or an obstacle.
struct SurfaceBody {
  const std::vector<std::array<int, 3>>* triangle = nullptr;  ///< shared, outward
  /// Shared; empty for a body that never meets itself and is only probed.
  const geometry::Topology* topology = nullptr;
  std::vector<Vec3> node;  ///< um
  // written by refresh_body:
  std::vector<Vec3> node_normal;      ///< unit, area weighted
  std::vector<Vec3> triangle_normal;  ///< unit
  std::vector<Vec3> center;           ///< of each triangle
  std::vector<double> reach;          ///< um, circumradius about the centre of each triangle
  Box box;
};

/// Recomputes everything that follows from the nodes.
void refresh_body(SurfaceBody& body);

/// Points lie in groups that are searched for together, the sites: triangles, or nodes, or nodes
/// and then edges (site - n_node).
inline bool has_face_sites(Quadrature q) { return q == Quadrature::kThreePoint; }
inline int points_per_site(Quadrature q) { return has_face_sites(q) ? 3 : 1; }
inline std::size_t n_sites(const SurfaceBody& b, Quadrature q) {
  if (has_face_sites(q)) return b.triangle->size();
  if (q == Quadrature::kNodes) return b.node.size();
  return b.node.size() + b.topology->edge.size();
}
inline std::size_t n_points(const SurfaceBody& b, Quadrature q) {
  return n_sites(b, q) * points_per_site(q);
}

/// Where a site is: the triangle's centre, the node, or the midpoint of the edge.
inline Vec3 site_place(const SurfaceBody& b, Quadrature q, std::size_t site) {
  if (has_face_sites(q)) return b.center[site];
  if (site < b.node.size()) return b.node[site];
  const auto& [i, j] = b.topology->edge[site - b.node.size()];
  return 0.5 * (b.node[i] + b.node[j]);
}

/// How far from its place the corners of a site's triangle are, um; its points are half as far.
inline double site_reach(const SurfaceBody& b, Quadrature q, std::size_t site) {
  return has_face_sites(q) ? b.reach[site] : 0;
}

/// Outward unit normal of a site; on an edge the mean of its two faces'.
inline Vec3 site_normal(const SurfaceBody& b, Quadrature q, std::size_t site) {
  if (has_face_sites(q)) return b.triangle_normal[site];
  if (site < b.node.size()) return b.node_normal[site];
  const auto& [s, t] = b.topology->edge_triangle[site - b.node.size()];
  // Eigen leaves a zero vector (the faces are folded flat on each other) as it is.
  return (b.triangle_normal[s] + b.triangle_normal[t]).normalized();
}

/// Whether two surfaces can touch where their outward normals are these. Beside each other still
/// counts: a rim that bends away is held. What turns its back does not: it is the far side of a
/// thin part of a cell.
inline bool are_facing(const Vec3& outward, const Vec3& other_outward) {
  constexpr double kMostAlike = 0.2;
  return outward.dot(other_outward) <= kMostAlike;
}

/// The nodes and weights that make up one probing point.
struct PointStencil {
  int n = 0;
  /// All different if n > 1: the solver knows places on faces, so that the midpoint of an edge
  /// names the opposite corner of a face as well, with weight 0.
  std::array<int, 3> node{};
  std::array<double, 3> weight{};  ///< the first two are float numbers; the third makes them 1
};
inline PointStencil point_stencil(const SurfaceBody& body, Quadrature q, int point) {
  const int n_node = static_cast<int>(body.node.size());
  if (q == Quadrature::kNodes || (q == Quadrature::kNodesAndEdges && point < n_node))
    return {1, {point, 0, 0}, {1, 0, 0}};
  if (q == Quadrature::kNodesAndEdges) {
    const auto& hinge = body.topology->hinge[point - n_node];
    return {2, {hinge[2], hinge[3], hinge[0]}, {0.5, 0.5, 0}};
  }
  constexpr double kSmall = 1.0f / 6, kLarge = 2.0f / 3;
  const int local = point % 3;
  const double w0 = local == 0 ? kLarge : kSmall, w1 = local == 1 ? kLarge : kSmall;
  return {3, (*body.triangle)[point / 3], {w0, w1, 1 - w0 - w1}};
}

inline Vec3 point_position(const SurfaceBody& body, const PointStencil& s) {
  auto node = [&](int k) -> const Vec3& { return body.node[s.node[k]]; };
  if (s.n == 1) return node(0);
  if (s.n == 2) return s.weight[0] * node(0) + s.weight[1] * node(1);
  return s.weight[0] * node(0) + s.weight[1] * node(1) + s.weight[2] * node(2);
}

}  // namespace acinus::contact
