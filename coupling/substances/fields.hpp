#pragma once
/// Fields of substances around the cells of a world.

#include <array>
#include <span>
#include <vector>

#include "coupling/substances/open_spaces.hpp"
#include "coupling/substances/responses.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"
#include "substances/shares.hpp"
#include "substances/solve.hpp"

namespace acinus::coupling {

/// Scratch of advance_substances, sized at its first call.
struct SubstanceWorkspace {
  substances::Solver solver;
  ObstacleCover obstacles;
  std::vector<double> held;  ///< [n_voxel] amounts before a step, per volume of a voxel
  std::array<int, 3> n{};    ///< voxels that the solver is sized for
};

/// Sets all fields to their initial values.
void begin_substances(const SubstanceParams& params, State& state);

/// Sets the open fractions of the state to those of the present cells. Concentrations around cells
/// stay, those inside cells behind membranes are the initial ones.
void begin_open_spaces(World& world);

/// Shares of all cells in the voxels, in the order of for_each_cell.
/// @param by_area  false: the voxels of their inside; true: those of their surface, for substances
///                 that are kept out of them
substances::Shares share_cells(const SubstanceParams& params, const State& state,
                               bool by_area = false);

/// Advances all fields over a step of the tissue, with the cells where they are. Cells in lysis
/// exchange nothing. Cells that moved since the last step leave amounts where they are; those of
/// voxels that closed go to the nearest open ones. A box that grows does so before.
/// @throws Error(kCannotContinue) if a field does not converge, or if no space is left
void advance_substances(World& world, double step, SubstanceWorkspace& work, Timings& timings);

/// Next time after `time` at which the supply of a substance jumps or bends, s since t = 0;
/// infinite if there is none.
double next_supply_change(const SubstanceParams& params, double time);

/// Amount of a substance in the box.
double amount_of(const SubstanceParams& params, const SubstanceState& field);

/// Mean concentration in each cell, or at its surface if the substance is kept out of it;
/// [substance][dcm lanes, then cbm cells]; empty without substances.
std::vector<std::vector<double>> cell_concentrations(const World& world);

/// Signals of the rules of some behaviours: concentrations as above, ages, values measured last.
RuleSignals rule_signals(const World& world, std::span<const Behaviour> behaviours);

/// Secretion minus uptake of each cell, amount / s at the present concentrations;
/// indexed as cell_concentrations.
std::vector<std::vector<double>> cell_exchange_rates(const World& world);

}  // namespace acinus::coupling
