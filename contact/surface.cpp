#include "contact/surface.hpp"

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
  b.normal.resize(n);
  b.center.resize(n);
  b.reach.resize(n);
  for (std::size_t t = 0; t < n; ++t) {
    b.normal[t] = compute_normal(b, t);
    b.center[t] = compute_center(b, t);
    b.reach[t] = compute_reach(b, t, b.center[t]);
  }
}

}  // namespace acinus::contact
