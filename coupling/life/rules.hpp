#pragma once
/// Rules of life: cells due to divide, die or rest.

#include <vector>

#include "coupling/world/cell.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// True if any cell can ever grow or die.
bool has_life(const Params& params);

/// Draws cycle times and starts growth. Call once, at t = 0.
void begin_life(World& world);

/// Time to the next update of rules or inhibition, s; infinite without any.
double time_to_life_event(const World& world);

/// Starts or stops the growth of a cell in its cycle by the rules.
/// @param factor  of growth_factor
void set_growth(const Params& params, State& state, const Cell& cell, double factor);

/// True if a deformable cell has the size of division, regardless of rules.
bool has_doubled_shell(const State& state);

/// Cells due for an event.
struct Plan {
  std::vector<Cell> divide, remove, lyse;
  bool empty() const { return divide.empty() && remove.empty() && lyse.empty(); }
};

/// True if make_plan() reads the points of all cells now.
bool reads_points(const World& world);

/// Applies rules and inhibition if their time grid was crossed, and lists the cells that have
/// doubled, died or ended their lysis.
Plan make_plan(World& world, Workspace& work);

}  // namespace acinus::coupling
