#pragma once
/// Triangle surfaces as contact sees them: bodies with normals, and the points that probe them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/box.hpp"
#include "core/mesh/topology.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

/// Where the gap of a surface is sampled.
enum class Quadrature {
  kThreePoint,  ///< three interior points per triangle, weights (2/3, 1/6, 1/6)
  kNodes        ///< the nodes
};

/// A closed surface at one moment. Does not know whether it is a cell or an obstacle.
struct SurfaceBody {
  const std::vector<std::array<int, 3>>* triangle = nullptr;  ///< shared, outward
  const mesh::Topology* topology = nullptr;  ///< shared; empty for a body that never meets itself
  std::vector<Vec3> node;                    ///< um
  // written by refresh_body:
  std::vector<Vec3> node_normal;      ///< unit, area weighted
  std::vector<Vec3> triangle_normal;  ///< unit
  std::vector<Vec3> center;           ///< of each triangle
  std::vector<double> reach;          ///< um, circumradius about the centre of each triangle
  Box box;
};

/// Recomputes everything that follows from the nodes.
void refresh_body(SurfaceBody& body);

/// Points per site (a triangle, or a node) and number of sites.
inline int points_per_site(Quadrature q) { return q == Quadrature::kThreePoint ? 3 : 1; }
inline std::size_t n_sites(const SurfaceBody& b, Quadrature q) {
  return q == Quadrature::kThreePoint ? b.triangle->size() : b.node.size();
}

/// The nodes and weights that make up one probing point.
struct PointStencil {
  int n = 0;
  std::array<int, 3> node{};
  std::array<double, 3> weight{};  ///< the first two are float numbers; the third makes them 1
};
inline PointStencil point_stencil(const SurfaceBody& body, Quadrature q, int point) {
  if (q == Quadrature::kNodes) return {1, {point, 0, 0}, {1, 0, 0}};
  constexpr double kSmall = 1.0f / 6, kLarge = 2.0f / 3;
  const int local = point % 3;
  const double w0 = local == 0 ? kLarge : kSmall, w1 = local == 1 ? kLarge : kSmall;
  return {3, (*body.triangle)[static_cast<std::size_t>(point / 3)], {w0, w1, 1 - w0 - w1}};
}

inline Vec3 point_position(const SurfaceBody& body, const PointStencil& s) {
  auto node = [&](int k) -> const Vec3& {
    return body.node[static_cast<std::size_t>(s.node[static_cast<std::size_t>(k)])];
  };
  if (s.n == 1) return node(0);
  return s.weight[0] * node(0) + s.weight[1] * node(1) + s.weight[2] * node(2);
}

/// A probing point of body a near a triangle of body b.
struct SurfaceContact {
  int body_a = 0, point = 0;  ///< site * points_per_site + local index
  int body_b = 0, triangle_b = 0;
  /// Barycentric weights of the closest point for the first two corners, as the solver keeps them;
  /// gap and normal are those of the place these rounded weights name (of the exact place on a
  /// fixed body, which has no unknowns).
  std::array<float, 2> weight_b{};
  Vec3 normal = Vec3::Zero();  ///< d gap / d x_a: from b towards a when apart
  double gap = 0;              ///< um, negative: a's point is inside b

  std::array<double, 3> weights() const {
    const double w0 = static_cast<double>(weight_b[0]), w1 = static_cast<double>(weight_b[1]);
    return {w0, w1, 1 - w0 - w1};
  }
};

}  // namespace acinus::contact
