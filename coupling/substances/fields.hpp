#pragma once
/// Fields of substances around the cells of a world.

#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"
#include "substances/shares.hpp"
#include "substances/solve.hpp"

namespace acinus::coupling {

/// Scratch of advance_substances, sized at its first call.
struct SubstanceWorkspace {
  substances::Solver solver;
  bool sized = false;
};

/// Sets all fields to their initial values.
void begin_substances(const SubstanceParams& params, State& state);

/// Shares of all cells in the voxels, in the order of for_each_cell.
substances::Shares share_cells(const SubstanceParams& params, const State& state);

/// Advances all fields over a step of the tissue, with the cells where they are. Cells in lysis
/// exchange nothing.
/// @throws Error(kCannotContinue) if a field does not converge
void advance_substances(World& world, double step, SubstanceWorkspace& work, Timings& timings);

/// Next time after `time` at which the supply of a substance jumps or bends, s since t = 0;
/// infinite if there is none.
double next_supply_change(const SubstanceParams& params, double time);

/// Mean concentration in each cell, [substance][dcm lanes, then cbm cells]; empty without
/// substances.
std::vector<std::vector<double>> cell_concentrations(const World& world);

/// Secretion minus uptake of each cell, amount / s at the present concentrations;
/// indexed as cell_concentrations.
std::vector<std::vector<double>> cell_exchange_rates(const World& world);

}  // namespace acinus::coupling
