#pragma once
/// Which process works out which cells. All of them know the whole state; the work of a step is
/// shared by blocks of eight cells. Who owns what never enters a result.

#include <cstdint>
#include <span>

#include "core/solve/system.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The owners of the blocks of a world; whole where there are too few blocks to share: then every
/// process does all work itself.
solve::Ownership share_blocks(const World& world, std::span<const solve::Block> blocks);

}  // namespace acinus::coupling
