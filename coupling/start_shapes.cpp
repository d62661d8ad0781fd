#include "coupling/start_shapes.hpp"

#include <algorithm>

#include "core/box.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"
#include "dcm/shape/available_volume.hpp"
#include "dcm/shape/give_shape.hpp"
#include "geometry/box_pairs.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

struct StartBall {
  Vec3 center;
  double radius = 0;
  bool deformable = false;
  std::size_t at = 0;  ///< lane or sphere
};

std::vector<StartBall> list_balls(const State& s) {
  std::vector<StartBall> balls;
  for_each_cell(s, [&](const Cell& c) {
    balls.push_back(
        {center_of(s, c), sphere_radius(volume_of(s, c).at(s.clock.time)), c.deformable, c.at});
  });
  return balls;
}

/// Ball of a lane, enlarged to the nodes: they lie slightly outside the nominal ball, so that the
/// mesh has its volume.
std::vector<Vec3> cut_ball(const State& s, const StartBall& ball,
                           const std::vector<dcm::VolumeFace>& face) {
  const geometry::Topology& t = *s.dcm.group[ball.at / kLanes].topology;
  std::vector<Vec3> direction;
  double radius = 0;
  dcm::copy_nodes(s.dcm, ball.at, direction);
  for (Vec3& d : direction) {
    d -= ball.center;
    radius = std::max(radius, d.norm());
    d.normalize();
  }
  const dcm::AvailableVolume available(
      ball.center, [&](const Vec3& d) { return dcm::reach_to_faces(d, radius, face); });
  return available.fill(t, direction, {radius});
}

}  // namespace

CutCells cut_overlapping(World& world) {
  State& s = world.state;
  const std::vector<StartBall> balls = list_balls(s);
  std::vector<Box> box;
  for (const StartBall& b : balls) box.push_back(sphere_box(b.center, b.radius));
  const auto pairs = geometry::find_pairs(box, 0);

  std::vector<std::vector<dcm::VolumeFace>> face(balls.size());
  std::vector<std::uint8_t> deep(balls.size(), 0);
  for (const auto& [i, j] : pairs) {
    const StartBall &a = balls[i], &b = balls[j];
    const Vec3 way = b.center - a.center;
    const double distance = way.norm(), overlap = a.radius + b.radius - distance;
    if (!(overlap > 0) || !(distance > 0) || !(a.deformable || b.deformable)) continue;
    const double share = dcm::share_of_distance(a.radius, b.radius, distance);
    face[i].push_back({way / distance, share * distance});
    face[j].push_back({-way / distance, (1 - share) * distance});
    if (overlap > world.params.dcm_contact.max_depth) deep[i] = deep[j] = 1;
  }

  std::vector<std::size_t> cut;
  for (std::size_t k = 0; k < balls.size(); ++k)
    if (balls[k].deformable && deep[k] != 0) cut.push_back(k);
  std::vector<std::vector<Vec3>> node(cut.size());
  for_each_part(cut.size(),
                [&](std::size_t k) { node[k] = cut_ball(s, balls[cut[k]], face[cut[k]]); });
  CutCells result;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const StartBall& ball = balls[cut[k]];
    const dcm::Group& group = s.dcm.group[ball.at / kLanes];
    const double now = s.clock.time;
    dcm::give_shape(world.params.dcm[group.type],
                    {node[k], ball.radius, 1, {1, 0, now, now + dcm::kForgetShape}}, ball.at,
                    s.dcm);
    const double volume = geometry::compute_volume(node[k], group.topology->triangle);
    result.smallest_volume = std::min(result.smallest_volume, volume / sphere_volume(ball.radius));
    result.cells.push_back(s.dcm.lineage[ball.at]);
  }
  std::ranges::sort(result.cells);
  return result;
}

}  // namespace acinus::coupling
