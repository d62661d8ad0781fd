#include "contact/gap.hpp"

#include <cmath>
#include <cstddef>

#include "geometry/closest_point.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::contact {
namespace {

/// Search for the place of a surface nearest to a point, triangle by triangle.
struct NearestTriangle {
  const SurfaceBody& b;
  const Vec3& x;
  double reach;  ///< um, largest distance of interest
  Gap gap;       ///< nearest so far
  double least2;

  NearestTriangle(const SurfaceBody& body, const Vec3& point, double within)
      : b(body),
        x(point),
        reach(within),
        gap{within, Vec3::UnitZ(), 0, 0, 0},
        least2(within * within) {}

  void look(std::size_t t) {
    const double far = reach + triangle_reach(b, t);
    if ((x - triangle_center(b, t)).squaredNorm() > far * far) return;
    const auto& corner = (*b.triangle)[t];
    const geometry::ClosestPoint c =
        geometry::find_closest_point(x, b.node[corner[0]], b.node[corner[1]], b.node[corner[2]]);
    if (c.squared_distance >= least2) return;
    least2 = c.squared_distance;
    Vec3 out = Vec3::Zero();
    for (int m = 0; m < 3; ++m) out += c.weight[m] * b.node_normal[corner[m]];
    out.normalize();
    const Vec3 apart = x - c.point;
    const double sign = apart.dot(out) >= 0 ? 1.0 : -1.0, distance = std::sqrt(least2);
    gap.gap = sign * distance;
    gap.normal = distance > 0 ? Vec3(sign / distance * apart) : out;
  }
};

}  // namespace

Gap gap_to_mesh(const SurfaceBody& b, const Vec3& x, double reach) {
  NearestTriangle nearest(b, x, reach);
  for (std::size_t t = 0; t < b.triangle->size(); ++t) nearest.look(t);
  return nearest.gap;
}

Gap gap_to_triangles(const SurfaceBody& b, std::span<const int> triangles, const Vec3& x,
                     double reach) {
  NearestTriangle nearest(b, x, reach);
  for (const int t : triangles) nearest.look(static_cast<std::size_t>(t));
  return nearest.gap;
}

Gap gap_to_segment(const geometry::Network& network, int segment, const Vec3& x) {
  const geometry::NearestBall ball = geometry::nearest_ball(network, segment, x);
  Gap g;
  g.axis_distance = ball.apart.norm();
  g.radius = ball.radius;
  g.gap = g.axis_distance - g.radius;
  g.parameter = ball.parameter;
  if (g.axis_distance > 0) {
    g.normal = ball.apart / g.axis_distance;
  } else {  // on the axis every direction is out
    const auto& [a, b] = network.segment[segment];
    g.normal = (network.node[b] - network.node[a]).unitOrthogonal();
  }
  return g;
}

}  // namespace acinus::contact
