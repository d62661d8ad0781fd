#pragma once
/// Insides of cells behind membranes: their parts on the grid, and what these held before.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "coupling/substances/open_spaces.hpp"
#include "coupling/world/cell.hpp"
#include "substances/parts.hpp"
#include "substances/shares.hpp"

namespace acinus::coupling {

/// Parts of all cells, in the order of for_each_cell.
/// @param cover    [cell]
/// @param surface  shares of the cells by area
substances::Parts make_parts(const World& world, const std::vector<substances::Cover>& cover,
                             const substances::Shares& surface);

/// Shares of the cells in their parts.
/// @param first  number of the first part: that of voxels, or 0
substances::Shares share_parts(const substances::Parts& parts, std::size_t first);

/// Adds what cells held to their parts: in the same voxel, or the nearest one that a cell still
/// reaches into. What a mother held goes to her daughters, what a cell that is gone held to the
/// space around it.
/// @param held  [n_voxel, then parts] amounts per volume of a voxel, changed
void carry_insides(const World& world, const InsideState& before, const substances::Parts& parts,
                   const substances::OpenSpace& space, std::span<double> held);

/// State of parts with these concentrations.   @param concentration  [part]
InsideState keep_insides(const State& state, const substances::Parts& parts,
                         std::span<const double> concentration);

/// Shares of cells in the parts of a state; those of a newborn cell are its mother's.
class InsidesOfCells {
 public:
  InsidesOfCells(const State& state, const InsideState& inside);
  /// Shares in InsideState::concentration; none for a cell that it does not know.
  std::span<const substances::VoxelShare> of(const Cell& cell) const;

 private:
  const State& state_;
  std::vector<substances::VoxelShare> share_;
  std::unordered_map<std::int64_t, std::pair<std::size_t, std::size_t>> range_;  ///< by lineage
};

/// Lineage of a cell's mother; -1: none.
std::int64_t mother_of(const State& state, const Cell& cell);

/// Area of a cell's surface, um^2.
double area_of(const State& state, const Cell& cell);

}  // namespace acinus::coupling
