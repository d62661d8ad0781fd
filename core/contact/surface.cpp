#include "core/contact/surface.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::contact {
void refresh_body(SurfaceBody& b) {
  const auto& triangle = *b.triangle;
  b.node_normal.assign(b.node.size(), Vec3::Zero());
  b.triangle_normal.resize(triangle.size());
  b.center.resize(triangle.size());
  b.reach.resize(triangle.size());
  b.box = Box{};
  for (const Vec3& x : b.node) b.box.include(x);
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const Vec3& x0 = b.node[static_cast<std::size_t>(triangle[t][0])];
    const Vec3& x1 = b.node[static_cast<std::size_t>(triangle[t][1])];
    const Vec3& x2 = b.node[static_cast<std::size_t>(triangle[t][2])];
    const Vec3 n = (x1 - x0).cross(x2 - x0);
    b.center[t] = (x0 + x1 + x2) / 3;
    b.reach[t] =
        std::sqrt(std::max({(x0 - b.center[t]).squaredNorm(), (x1 - b.center[t]).squaredNorm(),
                            (x2 - b.center[t]).squaredNorm()}));
    const double norm = n.norm();
    b.triangle_normal[t] = norm > 0 ? Vec3(n / norm) : Vec3::Zero();
    for (int c : triangle[t]) b.node_normal[static_cast<std::size_t>(c)] += n;
  }
  for (Vec3& n : b.node_normal) {
    const double norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

PointStencil point_stencil(const SurfaceBody& body, Quadrature q, int point) {
  if (q == Quadrature::kNodes) return {1, {point, 0, 0}, {1, 0, 0}};
  const auto& corner = (*body.triangle)[static_cast<std::size_t>(point / 3)];
  constexpr double kSmall = 1.0f / 6, kLarge = 2.0f / 3;
  const int local = point % 3;
  const double w0 = local == 0 ? kLarge : kSmall, w1 = local == 1 ? kLarge : kSmall;
  return {3, corner, {w0, w1, 1 - w0 - w1}};
}

}  // namespace acinus::contact
