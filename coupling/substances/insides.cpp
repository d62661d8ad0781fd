#include "coupling/substances/insides.hpp"

#include <limits>

#include "core/sphere.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

using BodiesOf = std::unordered_map<std::int64_t, std::vector<std::size_t>>;

Vec3 center_of_voxel(const substances::VoxelGrid& grid, std::size_t voxel) {
  const auto [i, j, k] = grid.place(voxel);
  return grid.center(i, j, k);
}

/// Part of any of some bodies that is nearest to a voxel.
std::size_t nearest_of(const substances::VoxelGrid& grid, const substances::Parts& parts,
                       const std::vector<std::size_t>& bodies, std::size_t voxel) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t body : bodies) {
    const std::size_t part = substances::nearest_part(grid, parts, body, voxel);
    const double distance =
        (center_of_voxel(grid, parts.voxel[part]) - center_of_voxel(grid, voxel)).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = part;
  }
  return best;
}

}  // namespace

std::int64_t mother_of(const State& s, const Cell& c) {
  return c.index < s.cycle.size() ? s.cycle[c.index].parent : -1;
}

double area_of(const State& s, const Cell& c) {
  if (!c.deformable) {
    const double r = sphere_radius(s.cbm.volume[c.at].at(s.clock.time));
    return 4 * kPi * r * r;
  }
  std::vector<Vec3> node;
  dcm::copy_nodes(s.dcm, c.at, node);
  return geometry::compute_area(node, s.dcm.group[c.at / kLanes].topology->triangle);
}

substances::Parts make_parts(const World& world, const std::vector<substances::Cover>& cover,
                             const substances::Shares& surface) {
  const std::vector<Cell> cells = list_cells(world.state);
  substances::Parts parts;
  for (std::size_t b = 0; b < cells.size(); ++b)
    substances::add_body(world.params.substances.grid, cover[b], surface.of(b),
                         area_of(world.state, cells[b]), parts);
  return parts;
}

substances::Shares share_parts(const substances::Parts& parts, std::size_t first) {
  substances::Shares shares;
  shares.start = parts.start;
  for (std::size_t p = 0; p < parts.n(); ++p) shares.share.push_back({first + p, parts.volume[p]});
  return shares;
}

void carry_insides(const World& world, const InsideState& before, const substances::Parts& parts,
                   const substances::OpenSpace& space, std::span<double> held) {
  const substances::VoxelGrid& grid = world.params.substances.grid;
  const std::vector<Cell> cells = list_cells(world.state);
  BodiesOf heirs, daughters;
  for (std::size_t b = 0; b < cells.size(); ++b) {
    heirs[lineage_of(world.state, cells[b])] = {b};
    daughters[mother_of(world.state, cells[b])].push_back(b);
  }
  for (const auto& [mother, bodies] : daughters) heirs.try_emplace(mother, bodies);
  for (std::size_t p = 0; p < before.cell.size(); ++p) {
    const double amount = before.concentration[p] * before.volume[p] / grid.voxel_volume();
    const auto voxel = static_cast<std::size_t>(before.voxel[p]);
    const auto found = heirs.find(before.cell[p]);
    held[found == heirs.end() ? space.nearest[voxel]
                              : grid.n_voxel() + nearest_of(grid, parts, found->second, voxel)] +=
        amount;
  }
}

InsideState keep_insides(const State& s, const substances::Parts& parts,
                         std::span<const double> concentration) {
  const std::vector<Cell> cells = list_cells(s);
  InsideState inside;
  for (std::size_t b = 0; b < cells.size(); ++b)
    inside.cell.insert(inside.cell.end(), parts.start[b + 1] - parts.start[b],
                       lineage_of(s, cells[b]));
  inside.voxel.assign(parts.voxel.begin(), parts.voxel.end());
  inside.volume = parts.volume;
  inside.concentration.assign(concentration.begin(), concentration.end());
  return inside;
}

InsidesOfCells::InsidesOfCells(const State& state, const InsideState& inside) : state_(state) {
  for (std::size_t p = 0; p < inside.cell.size(); ++p) {
    share_.push_back({p, inside.volume[p]});
    range_.try_emplace(inside.cell[p], p, p).first->second.second = p + 1;
  }
}

std::span<const substances::VoxelShare> InsidesOfCells::of(const Cell& c) const {
  auto found = range_.find(lineage_of(state_, c));
  if (found == range_.end()) found = range_.find(mother_of(state_, c));
  if (found == range_.end()) return {};
  const auto [first, end] = found->second;
  return std::span(share_).subspan(first, end - first);
}

}  // namespace acinus::coupling
