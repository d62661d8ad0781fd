#include "dcm/shape/place_nucleus.hpp"

#include <algorithm>

#include "dcm/shape/cast.hpp"
#include "dcm/terms/nucleus_links.hpp"
#include "geometry/inner_ball.hpp"
#include "geometry/measures.hpp"
#include "geometry/nearest_rotation.hpp"

namespace acinus::dcm {
namespace {

/// Least size of a nucleus over that at rest, for a cell too thin for it; its bulk modulus and the
/// contact then adapt it to the available volume.
constexpr double kSmallest = 0.5;

const std::vector<int>& link_ends(const Group& g) {
  return shared_link_ends(*g.topology, *g.nucleus.topology);
}

/// Rotation that brings the nodes of a nucleus at rest nearest to the directions of the cortex
/// nodes that they are linked to (least squares).
Mat3 fit_rotation(const Group& g, std::span<const Vec3> node, const Vec3& center) {
  Mat3 sum = Mat3::Zero();
  for (int i = 0; i < g.nucleus.n_node(); ++i)
    sum += (node[link_ends(g)[i]] - center).normalized() *
           g.nucleus.topology->rest[i].normalized().transpose();
  return geometry::nearest_rotation(sum);
}

}  // namespace

std::vector<Vec3> place_nucleus(const Group& g, std::span<const Vec3> node, double radius,
                                double gap) {
  const geometry::InnerBall ball =
      geometry::find_inner_ball({{node.begin(), node.end()}, g.topology->triangle});
  const double r = std::clamp(ball.radius - gap, kSmallest * radius, radius);
  const Mat3 rotation = fit_rotation(g, node, ball.center);
  std::vector<Vec3> nucleus;
  for (const Vec3& x : g.nucleus.topology->rest)
    nucleus.push_back(ball.center + r * (rotation * x));
  return nucleus;
}

std::vector<Vec3> turn_nucleus(const Group& g, std::span<const Vec3> node,
                               std::span<const Vec3> old) {
  const geometry::Surface surface{{old.begin(), old.end()}, g.nucleus.topology->triangle};
  const Vec3 center = geometry::compute_centroid(surface.node, surface.triangle);
  return cast_sphere(*g.nucleus.topology, surface, center, fit_rotation(g, node, center))
      .value_or(std::vector<Vec3>{});
}

std::vector<double> link_ratios(const Group& g, double radius, std::span<const Vec3> node,
                                std::span<const Vec3> nucleus) {
  std::vector<double> ratio;
  for (int i = 0; i < g.nucleus.n_node(); ++i) {
    const int j = link_ends(g)[i];
    const double rest =
        radius * (g.topology->rest[j] - g.nucleus.size * g.nucleus.topology->rest[i]).norm();
    ratio.push_back((node[j] - nucleus[i]).norm() / rest);
  }
  return ratio;
}

}  // namespace acinus::dcm
