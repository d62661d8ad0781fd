#include "coupling/substances/open_spaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/gap.hpp"
#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Number of cells below which threads cost more than they save.
constexpr std::size_t kParallelCovers = 50;

substances::Cover cover_cell(const substances::VoxelGrid& grid, const State& s, const Cell& c) {
  if (!c.deformable)
    return substances::cover_sphere(grid, cbm::center_of(s.cbm, c.at),
                                    sphere_radius(s.cbm.volume[c.at].at(s.clock.time)));
  std::vector<Vec3> node;
  dcm::copy_nodes(s.dcm, c.at, node);
  return substances::cover_surface(grid, node, s.dcm.group[c.at / kLanes].topology->triangle);
}

/// Segments of a network near each voxel.
class NearSegments {
 public:
  NearSegments(const substances::VoxelGrid& grid, const geometry::Network& network)
      : grid_(grid), network_(network), reach_(grid.spacing.norm()), near_(grid.n_voxel()) {
    for (std::size_t k = 0; k < network.segment.size(); ++k) {
      const auto [a, b] = network.segment[k];
      const double r = std::max(network.radius[k][0], network.radius[k][1]);
      const Box box = segment_box(network.node[a], network.node[b]).grown(r + reach_);
      if (!box.overlaps(grid.box())) continue;
      const std::array<int, 3> low = grid.voxel_at(box.low), high = grid.voxel_at(box.high);
      for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
          for (int x = low[0]; x <= high[0]; ++x)
            near_[grid.index(x, y, z)].push_back(static_cast<int>(k));
    }
  }

  /// Gap to the network, um, at most the diagonal of a voxel.
  double gap(const Vec3& x) const {
    double least = reach_;
    for (const int k : near_[grid_.index_at(x)])
      least = std::min(least, contact::gap_to_segment(network_, k, x).gap);
    return least;
  }

 private:
  const substances::VoxelGrid& grid_;
  const geometry::Network& network_;
  double reach_;
  std::vector<std::vector<int>> near_;  ///< [n_voxel]
};

void append(const substances::Cover& from, substances::Cover& to) {
  to.volume.insert(to.volume.end(), from.volume.begin(), from.volume.end());
  for (int axis = 0; axis < 3; ++axis)
    to.face[axis].insert(to.face[axis].end(), from.face[axis].begin(), from.face[axis].end());
}

/// Everything outside a cover.
substances::Cover complement(const substances::VoxelGrid& grid, const substances::Cover& cover) {
  const auto invert = [](std::size_t n, const std::vector<substances::CoveredPart>& inside) {
    std::vector<substances::CoveredPart> outside(n);
    for (std::size_t k = 0; k < n; ++k) outside[k] = {k, 1};
    for (const substances::CoveredPart& p : inside) outside[p.at].fraction -= p.fraction;
    return outside;
  };
  substances::Cover outside;
  outside.volume = invert(grid.n_voxel(), cover.volume);
  for (int axis = 0; axis < 3; ++axis)
    outside.face[axis] = invert(grid.n_face(axis), cover.face[axis]);
  return outside;
}

substances::Cover cover_mesh(const substances::VoxelGrid& grid, const contact::StaticMesh& mesh) {
  if (!mesh.inside) return substances::cover_surface(grid, mesh.body.node, *mesh.triangle);
  std::vector<std::array<int, 3>> outward = *mesh.triangle;
  for (std::array<int, 3>& t : outward) std::swap(t[1], t[2]);
  return complement(grid, substances::cover_surface(grid, mesh.body.node, outward));
}

substances::Cover cover_obstacles(const Params& p, double time) {
  const substances::VoxelGrid& grid = p.substances.grid;
  const contact::Boundary& boundary = p.boundary;
  const geometry::Network& network = vessels_at_rest(p);
  const NearSegments vessels(grid, network);
  substances::Cover cover = substances::cover_region(grid, [&](const Vec3& x) {
    double least = vessels.gap(x);
    contact::for_each_wall(boundary, [&](contact::Partner, int, const auto& wall) {
      least = std::min(least, contact::gap_to_wall(wall, x, time).gap);
    });
    return least;
  });
  for (const contact::StaticMesh& mesh : boundary.meshes) append(cover_mesh(grid, mesh), cover);
  return cover;
}

bool moves(const contact::Plane& p) { return p.speed != 0; }
bool moves(const contact::Capsule& c) { return c.speed != 0; }
bool moves(const contact::Pipette&) { return false; }

/// True if a wall moves or will vanish.
bool walls_change(const contact::Boundary& boundary) {
  bool any = false;
  contact::for_each_wall(boundary, [&](contact::Partner, int, const auto& wall) {
    any = any || moves(wall) || std::isfinite(wall.opens);
  });
  return any;
}

/// Index of the space of a substance that is kept out.
std::size_t kind_of(const Substance& s) {
  return (s.outside_cells ? 1U : 0U) + (s.outside_obstacles ? 2U : 0U) - 1;
}

}  // namespace

const substances::OpenSpace* OpenSpaces::of(const Substance& substance) const {
  return substance.is_kept_out() ? &space[kind_of(substance)] : nullptr;
}

OpenSpaces find_open_spaces(const World& world, ObstacleCover& obstacles) {
  const SubstanceParams& p = world.params.substances;
  const State& s = world.state;
  OpenSpaces spaces;
  const auto any = [&](auto member) {
    return std::ranges::any_of(p.substance, [&](const Substance& x) { return x.*member; });
  };
  std::vector<substances::Cover>& cells = spaces.cells;
  if (any(&Substance::outside_cells)) {
    const std::vector<Cell> cell = list_cells(s);
    cells.resize(cell.size());
    for_each_index(cells.size(), cells.size() > kParallelCovers,
                   [&](std::size_t k) { cells[k] = cover_cell(p.grid, s, cell[k]); });
  }
  if (any(&Substance::outside_obstacles) &&
      (obstacles.time < 0 || walls_change(world.params.boundary))) {
    obstacles.time = wall_time(s.clock, s.clock.time);
    obstacles.cover = cover_obstacles(world.params, obstacles.time);
  }
  for (const Substance& substance : p.substance) {
    if (!substance.is_kept_out() || spaces.of(substance)->exists()) continue;
    substances::CoveredSpace covered(p.grid);
    if (substance.outside_obstacles) covered.add(obstacles.cover);
    if (substance.outside_cells)
      for (const substances::Cover& c : cells) covered.add(c);
    substances::OpenSpace open = covered.open(p.grid);
    check(std::ranges::any_of(open.volume, [](double v) { return v > 0; }),
          "no space is left for " + substance.name +
              ": cells and obstacles fill the box of the fields. Give a larger "
              "substance_grid.box, or let the substance pass.",
          Exit::kCannotContinue);
    spaces.space[kind_of(substance)] = std::move(open);
  }
  return spaces;
}

}  // namespace acinus::coupling
