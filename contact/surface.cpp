#include "contact/surface.hpp"

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
    const Vec3& x0 = b.node[triangle[t][0]];
    const Vec3& x1 = b.node[triangle[t][1]];
    const Vec3& x2 = b.node[triangle[t][2]];
    const Vec3 n = (x1 - x0).cross(x2 - x0);
    b.center[t] = (x0 + x1 + x2) / 3;
    b.reach[t] =
        std::sqrt(std::max({(x0 - b.center[t]).squaredNorm(), (x1 - b.center[t]).squaredNorm(),
                            (x2 - b.center[t]).squaredNorm()}));
    const double norm = n.norm();
    b.triangle_normal[t] = norm > 0 ? Vec3(n / norm) : Vec3::Zero();
    for (int c : triangle[t]) b.node_normal[c] += n;
  }
  for (Vec3& n : b.node_normal) {
    const double norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

}  // namespace acinus::contact
