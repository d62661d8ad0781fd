#pragma once
/// Exchange of daughters: the process that holds a mother divides it and sends the daughters to all
/// others.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/life/division.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Process that divides a deformable cell: its holder, or the root if all have it.
/// @pre cells have holders
inline int process_of(const State& s, const Cell& mother) {
  return std::max(0, s.cell_holder[mother.index]);
}
/// True if this process divides a cell.
inline bool is_mine(const World& world, const Cell& mother) {
  const State& s = world.state;
  return s.cell_holder.empty() || process_of(s, mother) == world.ranks.rank();
}

/// Sends the daughters to all processes. Collective.   @pre cells have holders
/// @param done       [mothers] 1: divided; known on the process of a mother, then on all
/// @param daughters  [mothers] likewise
/// @param why        [mothers] likewise, reason of those that were not divided
void announce_daughters(const World& world, const std::vector<Cell>& mothers,
                        std::vector<std::uint8_t>& done, std::vector<DaughterMeshes>& daughters,
                        std::vector<std::string>& why);

}  // namespace acinus::coupling
