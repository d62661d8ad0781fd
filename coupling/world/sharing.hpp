#pragma once
/// Which process works out which cells. All of them know the whole state; the work of a step is
/// shared by blocks of eight cells. Who owns what never enters a result.

#include <cstdint>
#include <span>
#include <unordered_map>

#include "coupling/world/world.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// What cells cost, as measured: by that they are shared.
struct MeasuredCost {
  std::unordered_map<std::int64_t, double> of_cell;  ///< s per step, by lineage
  double busy = 0;         ///< s, of this process since its start, when it was looked at last
  std::int64_t steps = 0;  ///< accepted since then
};

/// The owners of the blocks of a world; whole where there are too few blocks to share: then every
/// process does all work itself. To be called by all processes.
solve::Ownership share_blocks(const World& world, std::span<const solve::Block> blocks,
                              const MeasuredCost& cost);

/// f(lineage, lane) for the cells of a block; lanes count [dcm lanes, then cbm cells].
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
