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

/// Measured cost of cells of a block, s per step.
struct KnownCost {
  std::size_t block = 0;
  double n = 0, cost = 0;
};

/// Gathers the measured costs; each process has those of its cells.
std::vector<KnownCost> gather_measured(const Ranks& ranks, const State& s, std::size_t n_block,
                                       const MeasuredCost& measured) {
  std::vector<KnownCost> own, all;
  for (std::size_t b = 0; b < n_block && !measured.of_cell.empty(); ++b) {
    KnownCost known{b};
    for_each_cell_of(s, b, [&](std::int64_t lineage, std::size_t) {
      const auto at = std::ranges::lower_bound(measured.of_cell, lineage, {},
                                               &std::pair<std::int64_t, double>::first);
      if (at == measured.of_cell.end() || at->first != lineage) return;
      ++known.n;
      known.cost += at->second;
    });
    if (known.n > 0) own.push_back(known);
  }
  ranks.gather<KnownCost>(own, all);
  return all;
}

BlockCosts compute_costs(const World& world, std::span<const Vec3> first_point,
                         const solve::Blocks& blocks, const MeasuredCost& measured) {
  const State& s = world.state;
  BlockCosts out;
  std::vector<double> unknown;  // cells of each block
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Vec3 place = Vec3::Zero();
    double n = 0;
    for_each_cell_of(s, b, [&](std::int64_t, std::size_t lane) {
      place += first_point[lane];
      ++n;
    });
    out.place.push_back(place / std::max(n, 1.0));
    out.cost.push_back(0);
    unknown.push_back(n);
  }
  for (const KnownCost& k : gather_measured(world.ranks, s, blocks.size(), measured)) {
    out.cost[k.block] += k.cost;
    unknown[k.block] -= k.n;
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double of_cell = kPointCost * static_cast<double>(blocks[b].pattern->n_point);
    out.cost[b] = std::max(out.cost[b] + unknown[b] * of_cell, kPointCost);
  }
  return out;
}

}  // namespace

solve::Ownership share_blocks(const World& world, const solve::Blocks& blocks,
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
    const BlockCosts costs = compute_costs(world, first, blocks, cost);
    o.owner = partition(world.ranks, costs.place, costs.cost);
  }
  return o;
}

}  // namespace acinus::coupling
