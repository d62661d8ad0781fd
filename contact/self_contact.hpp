#pragma once
/// Parts of a surface that may be in contact with each other.

#include <cstddef>

#include "contact/surface.hpp"

namespace acinus::contact {

/// Least distance along the surface between the sides of a self-contact, in rest edges.
inline constexpr double kSelfRings = 3.0;

/// Centre of a triangle on the unit rest shape.
inline Vec3 rest_center(const geometry::Topology& t, std::size_t triangle) {
  Vec3 sum = Vec3::Zero();
  for (int c : t.triangle[triangle]) sum += t.rest[c];
  return sum / 3;
}

/// True if a site and a triangle are far enough apart along the rest shape for self-contact.
inline bool far_on_surface(const SurfaceBody& b, Quadrature q, std::size_t site,
                           std::size_t triangle) {
  const geometry::Topology& t = *b.topology;
  Vec3 from;
  if (has_face_sites(q)) {
    from = rest_center(t, site);
  } else if (site < t.rest.size()) {
    from = t.rest[site];
  } else {
    const auto& [i, j] = t.edge[site - t.rest.size()];
    from = 0.5 * (t.rest[i] + t.rest[j]);
  }
  return (from - rest_center(t, triangle)).norm() > kSelfRings * t.mean_rest_length;
}

/// True if a body is so far from star-shaped that self-contact is possible. While all normals are
/// within about 70 degrees of the direction from the centre, facing sides open at 40 degrees or
/// more and come close only at the bottom of a cleft, where they are neighbours along the surface.
inline bool may_fold(const SurfaceBody& b) {
  constexpr double kStar = 0.35;
  Vec3 center = Vec3::Zero();
  for (const Vec3& x : b.node) center += x;
  center /= static_cast<double>(b.node.size());
  for (std::size_t t = 0; t < b.triangle->size(); ++t) {
    const Vec3 out = triangle_center(b, t) - center;
    if (triangle_normal(b, t).dot(out) < kStar * out.norm()) return true;
  }
  return false;
}

}  // namespace acinus::contact
