#include "geometry/inner_ball.hpp"

#include <cmath>
#include <queue>
#include <vector>

#include "core/sphere.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {

namespace {

// Distance to the surface, positive inside.
double compute_depth(const Surface& surface, const Vec3& point) {
  const double distance = compute_distance(point, surface.node, surface.triangle);
  return is_inside(point, surface.node, surface.triangle) ? distance : -distance;
}

struct SearchCube {
  Vec3 center = Vec3::Zero();
  double half = 0;   // of its side
  double bound = 0;  // no point in it is deeper
};

struct Shallower {
  bool operator()(const SearchCube& a, const SearchCube& b) const { return a.bound < b.bound; }
};

}  // namespace

InnerBall find_inner_ball(const Surface& surface) {
  InnerBall best;
  const double volume = compute_volume(surface.node, surface.triangle);
  if (!(volume > 0)) return best;
  const double precision = 0.05 * sphere_radius(volume);
  std::priority_queue<SearchCube, std::vector<SearchCube>, Shallower> queue;
  const auto add = [&](const Vec3& center, double half) {
    const double depth = compute_depth(surface, center);
    if (depth > best.radius) best = {center, depth};
    const double bound = depth + half * std::sqrt(3.0);
    if (bound > best.radius + precision) queue.push({center, half, bound});
  };
  Vec3 low = surface.node.at(0), high = low;
  for (const Vec3& x : surface.node) low = low.cwiseMin(x), high = high.cwiseMax(x);
  add(compute_centroid(surface.node, surface.triangle), 0);
  add((low + high) / 2, (high - low).maxCoeff() / 2);
  while (!queue.empty() && queue.top().bound > best.radius + precision) {
    const SearchCube cube = queue.top();
    queue.pop();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 to(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      add(cube.center + cube.half / 2 * to, cube.half / 2);
    }
  }
  return best;
}

}  // namespace acinus::geometry
