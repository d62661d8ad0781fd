#include "runs/experiments/flooded_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace acinus::runs {
namespace {

std::size_t cube_index(const FloodLattice& f, int x, int y, int z) {
  return (static_cast<std::size_t>(z) * f.n[1] + y) * f.n[0] + x;
}

Vec2 point_of(const FloodLattice& f, int x, int y) {
  return {f.low[0] + (x + 0.5) * f.spacing, f.low[1] + (y + 0.5) * f.spacing};
}

/// Membership of a point in the initial lesion: in the sector of the lobule, between vein and edge.
bool in_lesion(const LesionGrid& grid, const LobuleDomain& lobule, const Vec2& from_axis) {
  const double r = from_axis.norm(), angle = std::atan2(from_axis.y(), from_axis.x());
  return r >= grid.from_radius && r <= grid.to_radius && angle >= lobule.from_angle &&
         angle <= lobule.to_angle;
}

/// Points of every cube that are free, and those of them that cells cover.
struct CubeCounts {
  std::vector<int> free, covered;
};

CubeCounts count_points(const FloodLattice& f, const std::vector<Section>& sections) {
  const int nx = f.n[0] * f.points, ny = f.n[1] * f.points;
  const std::size_t cubes = static_cast<std::size_t>(f.n[0]) * f.n[1] * f.n[2];
  CubeCounts counts{std::vector<int>(cubes, 0), std::vector<int>(cubes, 0)};
  auto free = f.free.begin();
  for (std::size_t k = 0; k < sections.size(); ++k)
    for (int y = 0; y < ny; ++y) {
      const std::vector<Chord> covered =
          covered_pieces(sections[k], {f.low[0], point_of(f, 0, y).y()}, Vec2::UnitX(), 0);
      auto piece = covered.begin();
      for (int x = 0; x < nx; ++x, ++free) {
        const double along = (x + 0.5) * f.spacing;
        while (piece != covered.end() && (*piece)[1] < along) ++piece;
        if (*free == 0) continue;
        const std::size_t cube = cube_index(f, x / f.points, y / f.points, f.layer[k]);
        ++counts.free[cube];
        if (piece != covered.end() && (*piece)[0] <= along) ++counts.covered[cube];
      }
    }
  return counts;
}

/// Cubes that are reached from the seeds through faces of open ones.
std::vector<std::uint8_t> flood(const FloodLattice& f, const CubeCounts& counts) {
  std::vector<std::uint8_t> reached(counts.free.size(), 0);
  std::vector<std::array<int, 3>> front;
  const auto enter = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= f.n[0] || y >= f.n[1] || z >= f.n[2]) return;
    const std::size_t cube = cube_index(f, x, y, z);
    if (reached[cube] != 0 || 2 * counts.covered[cube] >= counts.free[cube]) return;
    reached[cube] = 1;
    front.push_back({x, y, z});
  };
  for (int z = 0; z < f.n[2]; ++z)
    for (int y = 0; y < f.n[1]; ++y)
      for (int x = 0; x < f.n[0]; ++x)
        if (f.seed[cube_index(f, x, y, z)] != 0) enter(x, y, z);
  while (!front.empty()) {
    const auto [x, y, z] = front.back();
    front.pop_back();
    for (const int step : {-1, 1}) {
      enter(x + step, y, z);
      enter(x, y + step, z);
      enter(x, y, z + step);
    }
  }
  return reached;
}

}  // namespace

FloodLattice make_flood_lattice(const LesionGrid& grid, const LobuleDomain& lobule,
                                const geometry::Network& vessels) {
  FloodLattice f;
  const double edge = lobule.frame.cell_radius;
  f.spacing = edge / f.points;
  const int across = std::max(1, static_cast<int>(std::ceil(2 * grid.to_radius / edge)));
  f.n[0] = f.n[1] = across;
  f.n[2] = std::max(1, static_cast<int>(std::lround(lobule.frame.height / edge)));
  for (int k = 0; k < 2; ++k) f.low[k] = grid.axis[k] - 0.5 * across * edge;
  for (const double z : grid.height)
    f.layer.push_back(std::min(f.n[2] - 1, static_cast<int>(z / lobule.frame.height * f.n[2])));

  const double beside_vein = grid.from_radius + edge;
  const std::vector<Box> boxes = segment_boxes(vessels);
  f.seed.assign(static_cast<std::size_t>(across) * across * f.n[2], 0);
  for (std::size_t k = 0; k < grid.height.size(); ++k)
    for (int y = 0; y < across * f.points; ++y)
      for (int x = 0; x < across * f.points; ++x) {
        const Vec2 p = point_of(f, x, y), from_axis = p - grid.axis.head<2>();
        bool free = in_lesion(grid, lobule, from_axis);
        const Vec3 place(p.x(), p.y(), grid.height[k]);
        for (std::size_t s = 0; free && s < vessels.segment.size(); ++s)
          free = !boxes[s].contains(place) ||
                 contact::gap_to_segment(vessels, static_cast<int>(s), place).gap >= 0;
        f.free.push_back(free ? 1 : 0);
        if (free && from_axis.norm() < beside_vein)
          f.seed[cube_index(f, x / f.points, y / f.points, f.layer[k])] = 1;
      }
  return f;
}

double measure_flooded_area(const FloodLattice& f, const std::vector<Section>& sections) {
  if (sections.empty()) return 0;
  const CubeCounts counts = count_points(f, sections);
  const std::vector<std::uint8_t> reached = flood(f, counts);
  double points = 0;
  for (std::size_t cube = 0; cube < reached.size(); ++cube)
    if (reached[cube] != 0) points += counts.free[cube];
  return points * f.spacing * f.spacing / static_cast<double>(sections.size());
}

}  // namespace acinus::runs
