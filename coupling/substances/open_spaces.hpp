#pragma once
/// Space that cells and obstacles leave to substances that are kept out of them.

#include <array>
#include <vector>

#include "coupling/world/world.hpp"
#include "substances/cover.hpp"
#include "substances/open_space.hpp"

namespace acinus::coupling {

/// Walls, vessels and static meshes on the grid at a time; vessels as they are at rest.
struct ObstacleCover {
  substances::Cover cover;
  double time = -1;  ///< s after t = 0; -1: none yet
};

/// Open spaces of the substances of a world.
struct OpenSpaces {
  /// By what a substance is kept out of: cells, obstacles, both. Empty where no substance needs it.
  std::array<substances::OpenSpace, 3> space;
  /// Covers of the cells, in the order of for_each_cell; empty if no substance is kept out of them.
  std::vector<substances::Cover> cells;

  /// Space of a substance; nullptr: everywhere.
  const substances::OpenSpace* of(const Substance& substance) const;
};

/// Finds the spaces with the cells where they are.
/// @param obstacles  kept between calls; computed anew if a wall moves
/// @throws Error(kCannotContinue) if no space is left
OpenSpaces find_open_spaces(const World& world, ObstacleCover& obstacles);

}  // namespace acinus::coupling
