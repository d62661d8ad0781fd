#pragma once
/// Partition of the cells among processes, by the first points of all cells; the work of a
/// step is shared by blocks of eight cells. Results do not depend on ownership.

#include <cstdint>
#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// Partitions the blocks of a world. With too few blocks ownership is whole: every process computes
/// everything. Collective call.
solve::Ownership share_blocks(const World& world, const solve::Blocks& blocks,
                              const MeasuredCost& cost);

/// Calls f(lineage, lane) for the cells of a block; lanes count [dcm lanes, then cbm cells].
template <class F>
void for_each_cell_of(const State& s, std::size_t block, F f) {
  for (std::size_t lane = block * kLanes; lane < (block + 1) * kLanes; ++lane) {
    if (lane < s.dcm.n_lane()) {
      if (s.dcm.active(lane)) f(s.dcm.lineage[lane], lane);
    } else if (lane - s.dcm.n_lane() < s.cbm.n_cell()) {
      f(s.cbm.lineage[lane - s.dcm.n_lane()], lane);
    }
  }
}

}  // namespace acinus::coupling
