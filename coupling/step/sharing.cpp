#include "coupling/step/sharing.hpp"

#include <algorithm>
#include <vector>

#include "core/numbers/random.hpp"
#include "core/parallel/partition.hpp"
#include "coupling/step/held_cells.hpp"

namespace acinus::coupling {
namespace {

/// Least number of blocks per process for which sharing pays.
constexpr std::size_t kLeastBlocks = 2;
/// Initial estimate of the cost of a point, s per step, the same for all bodies.
constexpr double kPointCost = 2e-6;

/// Assigns every block to a random process.
std::vector<int> draw_owners(const World& world, std::size_t n_block) {
  std::vector<int> owner;
  const auto seed = static_cast<std::uint64_t>(world.state.next_lineage);
  for (std::size_t b = 0; b < n_block; ++b)
    owner.push_back(static_cast<int>(uniform({seed, Purpose::kSharing, b, 0, 0}) *
                                     static_cast<double>(world.ranks.size())));
  return owner;
}

/// Positions of blocks, by the first points of their cells, and their costs.
struct BlockCosts {
  std::vector<Vec3> place;
  std::vector<double> cost;
};

BlockCosts compute_costs(const State& s, std::span<const Vec3> first_point,
                         std::span<const solve::Block> blocks, const MeasuredCost& measured) {
  BlockCosts out;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto n_point = static_cast<std::size_t>(blocks[b].pattern->n_point);
    Vec3 place = Vec3::Zero();
    double cost = 0, n = 0;
    for_each_cell_of(s, b, [&](std::int64_t lineage, std::size_t lane) {
      place += first_point[lane];
      ++n;
      const auto known = std::ranges::lower_bound(measured.of_cell, lineage, {},
                                                  &std::pair<std::int64_t, double>::first);
      cost += known != measured.of_cell.end() && known->first == lineage
                  ? known->second
                  : kPointCost * static_cast<double>(n_point);
    });
    out.place.push_back(place / std::max(n, 1.0));
    out.cost.push_back(std::max(cost, kPointCost));
  }
  return out;
}

}  // namespace

solve::Ownership share_blocks(const World& world, std::span<const solve::Block> blocks,
                              const MeasuredCost& cost) {
  solve::Ownership o;
  const bool random = world.sharing == Sharing::kRandom;
  const std::size_t least =
      random ? 1 : kLeastBlocks * static_cast<std::size_t>(world.ranks.size());
  if (world.ranks.is_alone() || blocks.size() < least) return o;
  o.ranks = world.ranks;
  if (random) {
    o.owner = draw_owners(world, blocks.size());
  } else {
    const State& s = world.state;
    const std::vector<Vec3> first = gather_places(world.ranks, s, [&s](std::size_t lane) {
      return load_point(position_of(s, first_point_of(s, lane)), 0);
    });
    const BlockCosts costs = compute_costs(s, first, blocks, cost);
    o.owner = partition(world.ranks, costs.place, costs.cost);
  }
  return o;
}

}  // namespace acinus::coupling
