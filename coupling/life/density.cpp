#include "coupling/life/density.hpp"

#include <algorithm>

#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Contribution of a cell to the density at its centre.
struct Contribution {
  Vec3 center;
  double amount;
};

/// Cells and their mirror images. Each plane mirrors the images of the planes before it, so corners
/// have images of images.
std::vector<Contribution> with_images(const World& world, std::vector<Contribution> all) {
  const double time = std::max(0.0, time_since_start(world));
  for (const contact::Plane& p : world.params.boundary.planes) {
    if (!p.material.mirror) continue;
    const Vec3 normal = p.normal.normalized(), point = p.point_at(time);
    const std::size_t n = all.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double depth = (all[k].center - point).dot(normal);
      if (depth >= 0 && depth < kDensityReach)
        all.push_back({all[k].center - 2 * depth * normal, all[k].amount});
    }
  }
  return all;
}

/// Sum of the contributions in the ball around each cell, per volume of the ball.
/// @param amount  contribution of a cell
template <class Amount>
std::vector<double> sum_around(const World& world, Amount amount) {
  const State& s = world.state;
  std::vector<double> sum(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
  std::vector<std::size_t> index;
  std::vector<Contribution> cells;
  for_each_cell(s, [&](const Cell& c) {
    index.push_back(c.index);
    cells.push_back({center_of(s, c), amount(c)});
  });
  const std::vector<Contribution> all = with_images(world, cells);
  for_each_index(cells.size(), cells.size() > 200, [&](std::size_t k) {
    double here = 0;
    for (const Contribution& other : all)
      if ((other.center - cells[k].center).squaredNorm() <= kDensityReach * kDensityReach)
        here += other.amount;
    sum[index[k]] = here / sphere_volume(kDensityReach);
  });
  return sum;
}

}  // namespace

std::vector<double> local_densities(const World& world) {
  return sum_around(world, [](const Cell&) { return 1.0; });
}

std::vector<double> local_volume_shares(const World& world) {
  const State& s = world.state;
  return sum_around(world, [&](const Cell& c) { return volume_of(s, c).at(s.clock.time); });
}

}  // namespace acinus::coupling
