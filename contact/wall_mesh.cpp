#include "contact/wall_mesh.hpp"

#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "contact/gap.hpp"
#include "core/box.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::contact {
namespace {

/// Segment with the nearest cone surface, of those whose boxes contain a point.
int segment_of_wall(const geometry::Network& network, std::span<const Box> box, const Vec3& x) {
  int nearest = -1;
  double least = 0;
  const auto look = [&](std::size_t s) {
    const double distance = std::abs(gap_to_segment(network, static_cast<int>(s), x).gap);
    if (nearest >= 0 && distance >= least) return;
    nearest = static_cast<int>(s);
    least = distance;
  };
  for (std::size_t s = 0; s < box.size(); ++s)
    if (box[s].contains(x)) look(s);
  if (nearest < 0)
    for (std::size_t s = 0; s < box.size(); ++s) look(s);
  return nearest;
}

}  // namespace

WallMesh make_wall_mesh(const geometry::Network& network, geometry::Surface surface) {
  WallMesh wall;
  wall.surface = make_static_mesh("vessels", std::move(surface), false);
  // Bound of the distance of the surface about the vessels from an axis, over the cone's radius.
  constexpr double kWider = 1.3;
  std::vector<Box> box;
  for (std::size_t s = 0; s < network.segment.size(); ++s)
    box.push_back(geometry::cone_box(network, s, kWider));
  wall.segment.resize(wall.surface.triangle->size());
  for_each_index(wall.segment.size(), true, [&](std::size_t t) {
    wall.segment[t] = segment_of_wall(network, box, wall.surface.body.center[t]);
  });
  wall.first_of_segment.assign(network.segment.size() + 1, 0);
  for (const int s : wall.segment) ++wall.first_of_segment[static_cast<std::size_t>(s) + 1];
  std::partial_sum(wall.first_of_segment.begin(), wall.first_of_segment.end(),
                   wall.first_of_segment.begin());
  wall.of_segment.resize(wall.segment.size());
  std::vector<std::size_t> next = wall.first_of_segment;
  for (std::size_t t = 0; t < wall.segment.size(); ++t)
    wall.of_segment[next[wall.segment[t]]++] = static_cast<int>(t);
  return wall;
}

}  // namespace acinus::contact
