#include "contact/surface.hpp"

#include <utility>

namespace acinus::contact {

void refresh_nodes(SurfaceBody& b) {
  b.normal.clear();
  b.center.clear();
  b.reach.clear();
  b.node_normal.assign(b.node.size(), Vec3::Zero());
  b.box = Box{};
  for (const Vec3& x : b.node) b.box.include(x);
  for (std::size_t t = 0; t < b.triangle->size(); ++t) {
    const Vec3 n = area_normal(b, t);
    for (int c : (*b.triangle)[t]) b.node_normal[c] += n;
  }
  for (Vec3& n : b.node_normal) {
    const double norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

void refresh_body(SurfaceBody& b) {
  refresh_nodes(b);
  const std::size_t n = b.triangle->size();
  std::vector<Vec3> normal(n), center(n);
  std::vector<double> reach(n);
  for (std::size_t t = 0; t < n; ++t) {
    normal[t] = triangle_normal(b, t);
    center[t] = triangle_center(b, t);
    reach[t] = triangle_reach(b, t);
  }
  b.normal = std::move(normal);
  b.center = std::move(center);
  b.reach = std::move(reach);
}

}  // namespace acinus::contact
