#pragma once
/// Which cells are to divide, die or rest now.

#include <vector>

#include "coupling/world/cell.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Whether any cell can ever grow or die.
bool has_life(const Params& params);

/// Draws cycle times and starts growth. Call once, at t = 0.
void begin_life(World& world);

/// Time until rules or inhibition are looked at again, s; infinite where there are none.
double time_to_life_event(const World& world);

/// Starts or stops the growth of a cell in its cycle as the rules say.
/// @param factor  of growth_factor
void set_growth(const Params& params, State& state, const Cell& cell, double factor);

/// Whether a deformable cell is as large as those that divide, whatever rules say about it.
bool has_doubled_shell(const State& state);

/// What is to happen to cells now.
struct Plan {
  std::vector<Cell> divide, remove, lyse;
  bool empty() const { return divide.empty() && remove.empty() && lyse.empty(); }
};

/// Applies rules and inhibition if their time grid was crossed, and finds the cells that have
/// doubled or shrunk to their end.
Plan make_plan(World& world, Workspace& work);

}  // namespace acinus::coupling
