#pragma once
/// Responses of cells to substances: growth, death, motility, chemotaxis, the heading of leaders,
/// secretion and uptake of substances.

#include <vector>

#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Response between 0 and 1 of a Hill function.
double signal_response(const SignalRule& rule, double concentration);

bool has_rule(const SubstanceParams& params, Behaviour behaviour);

/// Multiplies relative growth rates by the responses of the rules of growth.
/// @param concentration  of cell_concentrations
/// @param factor         [dcm lanes, then cbm cells]
void scale_growth(const World& world, const std::vector<std::vector<double>>& concentration,
                  std::vector<double>& factor);

/// True if a rule of death takes the cell in this interval of the time grid of life. The
/// probability is 1 - exp(-rate response grid).
bool dies_of_signal(const World& world, const Cell& cell,
                    const std::vector<std::vector<double>>& concentration, std::int64_t interval);

/// Factors on the rates of exchange of a cell with a substance.
struct ExchangeFactors {
  double secretion = 1, uptake = 1;
};

/// True if a rule of secretion or uptake acts.
bool has_exchange_rule(const SubstanceParams& params);

/// Products of the responses of the rules of secretion and uptake of a substance; 1 without rules.
/// @param concentration  of cell_concentrations; may be empty without such rules
ExchangeFactors exchange_factors(const SubstanceParams& params, int substance, int type,
                                 std::size_t index,
                                 const std::vector<std::vector<double>>& concentration);

/// Refreshes motility, force and heading from the fields at the cells' centres. The relative
/// difference of a concentration across a cell, d = 2 R |grad c| / c, gives both the share
/// d / (d + sensitivity).
void update_guidance(const SubstanceParams& params, State& state);

}  // namespace acinus::coupling
