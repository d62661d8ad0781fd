#include "contact/curved_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace acinus::contact {

CurvedTriangle make_curved_triangle(const std::array<Vec3, 3>& corner, double curvature) {
  const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], n = u.cross(v);
  const double n2 = n.squaredNorm();
  ACINUS_ASSERT(n2 > 0.0);
  const Vec3 to_center = (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n2);
  const double limit = 1.0 / to_center.norm();
  return {corner, n / std::sqrt(n2), corner[0] + to_center, to_center.norm(),
          std::clamp(curvature, -limit, limit)};
}

SphericalCap cap_of(const CurvedTriangle& t) {
  return {t.circumcenter, t.normal, t.circumradius, t.curvature};
}

FittedSphere fit_sphere(const SphericalCap& cap, double curvature) {
  ACINUS_ASSERT(curvature > 0.0);
  const double radius = std::max(1.0 / curvature, cap.rim_radius);
  const double height2 = (radius - cap.rim_radius) * (radius + cap.rim_radius);
  return {cap.middle - std::sqrt(height2) * cap.normal, radius};
}

std::vector<CurvedTriangle> make_curved_triangles(std::span<const Vec3> node,
                                                  geometry::Triangles triangle) {
  const geometry::MeanCurvature at_node = geometry::compute_mean_curvature(node, triangle);
  std::vector<CurvedTriangle> out;
  out.reserve(triangle.size());
  for (const auto& t : triangle) {
    CurvedTriangle curved = make_curved_triangle({node[t[0]], node[t[1]], node[t[2]]}, 0.0);
    double sum = 0.0;
    for (const int i : t)
      sum += std::copysign(at_node.normal[i].norm(), at_node.normal[i].dot(curved.normal));
    const double limit = 1.0 / curved.circumradius;
    curved.curvature = std::clamp(sum / 3.0, -limit, limit);
    out.push_back(curved);
  }
  return out;
}

}  // namespace acinus::contact
