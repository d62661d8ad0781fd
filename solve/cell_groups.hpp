#pragma once
/// Groups of cells that contacts join. The groups do not depend on owners; a process knows those
/// with own cells.

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/disjoint_sets.hpp"
#include "core/parallel/row_vector.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

/// Groups of a system. Cells are numbered by lane, block * kLanes + lane.
struct CellGroups {
  RowVector<int> of_cell;  ///< [n_block * kLanes] group of own cells, -1: empty lane
  std::size_t n = 0;       ///< groups with own cells, in the order of their first own cells
  /// [shared group] number of the groups with cells of several processes, -1: no own cell. In an
  /// order that all processes share.
  std::vector<int> shared;
  DisjointSets sets;  ///< scratch
};

/// Finds the groups of cells joined by contacts with a matrix. Collective.
/// @param active  [n_block * kLanes] 1 where the lane holds a cell
void find_groups(const System& system, std::span<const std::uint8_t> active, CellGroups& groups);

}  // namespace acinus::solve
