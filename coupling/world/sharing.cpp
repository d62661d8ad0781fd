#include "coupling/world/sharing.hpp"

#include "core/random.hpp"

namespace acinus::coupling {
namespace {

/// Blocks a process needs at least for sharing to be worth anything.
constexpr std::size_t kLeastBlocks = 2;

/// Every block to anyone.
std::vector<int> draw_owners(const World& world, std::size_t n_block) {
  std::vector<int> owner;
  const auto seed = static_cast<std::uint64_t>(world.state.next_lineage);
  for (std::size_t b = 0; b < n_block; ++b)
    owner.push_back(static_cast<int>(uniform({seed, Purpose::kSharing, b, 0, 0}) *
                                     static_cast<double>(world.ranks.size())));
  return owner;
}

}  // namespace

solve::Ownership share_blocks(const World& world, std::span<const solve::Block> blocks) {
  solve::Ownership o;
  const auto n_rank = static_cast<std::size_t>(world.ranks.size());
  const bool random = world.sharing == Sharing::kRandom;
  if (n_rank == 1 || (!random && blocks.size() < kLeastBlocks * n_rank)) return o;
  o.ranks = world.ranks;
  if (random) {
    o.owner = draw_owners(world, blocks.size());
    return o;
  }
  // Blocks stand along a space-filling curve, deformable cells first: runs of either model with as
  // much work each.
  std::size_t n_row = 0, row = 0;
  for (const solve::Block& b : blocks) n_row += static_cast<std::size_t>(b.pattern->n_point);
  for (const solve::Block& b : blocks) {
    const auto n = static_cast<std::size_t>(b.pattern->n_point);
    o.owner.push_back(static_cast<int>((row + n / 2) * n_rank / n_row));
    row += n;
  }
  return o;
}

}  // namespace acinus::coupling
