#pragma once
/// Triangle surfaces in the contact search: bodies with normals, and their probing points.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/box_pairs.hpp"
#include "geometry/topology.hpp"

namespace acinus::contact {

/// Sampling points of the gap of a surface.
enum class Quadrature {
  kThreePoint,    ///< three interior points per triangle, weights (2/3, 1/6, 1/6)
  kNodes,         ///< the nodes
  kNodesAndEdges  ///< the nodes, then the edge midpoints
};

/// Closed surface at one time, of a cell or of an obstacle.
struct SurfaceBody {
  const std::vector<std::array<int, 3>>* triangle = nullptr;  ///< shared, outward
  /// Shared; null for a body without self-contact that is only probed.
  const geometry::Topology* topology = nullptr;
  std::vector<Vec3> node;  ///< um
  // written by refresh_body and refresh_nodes:
  std::vector<Vec3> node_normal;  ///< unit, area weighted
  Box box;
  // written by refresh_body; empty after refresh_nodes, see triangle_normal() and the like:
  std::vector<Vec3> normal;   ///< of each triangle, unit
  std::vector<Vec3> center;   ///< of each triangle
  std::vector<double> reach;  ///< um, circumradius about the centre of each triangle
};

/// Recomputes all members that depend on the nodes.
void refresh_body(SurfaceBody& body);
/// Recomputes the members that depend on the nodes, without those of the triangles: these are two
/// thirds of a body, and few are of use in one step.
void refresh_nodes(SurfaceBody& body);

inline const Vec3& corner_of(const SurfaceBody& b, std::size_t triangle, std::size_t corner) {
  return b.node[(*b.triangle)[triangle][corner]];
}

/// Normal of a triangle times twice its area.
inline Vec3 area_normal(const SurfaceBody& b, std::size_t triangle) {
  const Vec3& x0 = corner_of(b, triangle, 0);
  return (corner_of(b, triangle, 1) - x0).cross(corner_of(b, triangle, 2) - x0);
}

/// Unit normal of a triangle from its nodes; zero if it is flat.
inline Vec3 compute_normal(const SurfaceBody& b, std::size_t triangle) {
  const Vec3 n = area_normal(b, triangle);
  const double norm = n.norm();
  return norm > 0 ? Vec3(n / norm) : Vec3::Zero();
}
inline Vec3 compute_center(const SurfaceBody& b, std::size_t triangle) {
  return (corner_of(b, triangle, 0) + corner_of(b, triangle, 1) + corner_of(b, triangle, 2)) / 3;
}
/// Circumradius of a triangle about its centre, um.
inline double compute_reach(const SurfaceBody& b, std::size_t triangle, const Vec3& center) {
  return std::sqrt(std::max({(corner_of(b, triangle, 0) - center).squaredNorm(),
                             (corner_of(b, triangle, 1) - center).squaredNorm(),
                             (corner_of(b, triangle, 2) - center).squaredNorm()}));
}

/// The same, as refresh_body has kept them, or else computed.
inline Vec3 triangle_normal(const SurfaceBody& b, std::size_t triangle) {
  return b.normal.empty() ? compute_normal(b, triangle) : b.normal[triangle];
}
inline Vec3 triangle_center(const SurfaceBody& b, std::size_t triangle) {
  return b.center.empty() ? compute_center(b, triangle) : b.center[triangle];
}
inline double triangle_reach(const SurfaceBody& b, std::size_t triangle) {
  return b.reach.empty() ? compute_reach(b, triangle, triangle_center(b, triangle))
                         : b.reach[triangle];
}

/// True if the sites are triangles. A site is a group of probing points that are searched together:
/// a triangle, or a node, or a node or an edge (numbered after the nodes).
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

/// Position of a site, um: the triangle's centre, the node, or the midpoint of the edge.
inline Vec3 site_place(const SurfaceBody& b, Quadrature q, std::size_t site) {
  if (has_face_sites(q)) return triangle_center(b, site);
  if (site < b.node.size()) return b.node[site];
  const auto& [i, j] = b.topology->edge[site - b.node.size()];
  return 0.5 * (b.node[i] + b.node[j]);
}

/// Distance of the corners of a site's triangle from its position, um; that of its points is half.
inline double site_reach(const SurfaceBody& b, Quadrature q, std::size_t site) {
  return has_face_sites(q) ? triangle_reach(b, site) : 0;
}

/// Outward unit normal of a site; on an edge the mean of its two faces'.
inline Vec3 site_normal(const SurfaceBody& b, Quadrature q, std::size_t site) {
  if (has_face_sites(q)) return triangle_normal(b, site);
  if (site < b.node.size()) return b.node_normal[site];
  const auto& [s, t] = b.topology->edge_triangle[site - b.node.size()];
  // Eigen leaves a zero vector (the faces are folded flat on each other) as it is.
  return (triangle_normal(b, s) + triangle_normal(b, t)).normalized();
}

/// True if surfaces with these outward normals can be in contact. Normals at right angles still
/// count, so that a rim that bends away stays in contact. Nearly equal normals do not: they belong
/// to the far side of a thin part of a cell.
inline bool are_facing(const Vec3& outward, const Vec3& other_outward) {
  constexpr double kMostAlike = 0.2;
  return outward.dot(other_outward) <= kMostAlike;
}

/// Nodes and weights of one probing point.
struct PointStencil {
  int n = 0;
  /// All different if n > 1: the solver stores places on faces, so that the midpoint of an edge
  /// also has the opposite corner of a face, with weight 0.
  std::array<int, 3> node{};
  std::array<double, 3> weight{};  ///< sum 1; the first two are float numbers
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
