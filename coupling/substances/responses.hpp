#pragma once
/// Responses of cells to signals: growth, death, motility, chemotaxis, the heading of leaders,
/// secretion and uptake of substances, adhesion.

#include <vector>

#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Signals of rules in cells, [rule][dcm lanes, then cbm cells]; empty for a rule that is not asked
/// for.
using RuleSignals = std::vector<std::vector<double>>;

/// Response between 0 and 1 of a Hill function.
double signal_response(const SignalRule& rule, double signal);

bool has_rule(const RuleParams& params, Behaviour behaviour);

/// True if a rule responds to a signal that must be measured (measure/signals.hpp).
bool has_measured_signal(const RuleParams& params);

/// True if a rule acts on this behaviour of a cell type.
bool acts_on(const SignalRule& rule, Behaviour behaviour, int type);

/// Time since the birth of a cell, s; of an initial cell since t = 0.
double age_of(const State& state, const Cell& cell);

/// Signal of rule k if it is no concentration: age, or the value measured last; 0 before any
/// measurement.
double own_signal(const RuleParams& params, std::size_t k, const State& state, const Cell& cell);

/// Multiplies relative growth rates by the responses of the rules of growth.
/// @param signal  of rule_signals
/// @param factor  [dcm lanes, then cbm cells]
void scale_growth(const World& world, const RuleSignals& signal, std::vector<double>& factor);

/// True if a rule of death takes the cell in this interval of the time grid of life. The
/// probability is 1 - exp(-rate response grid).
bool dies_of_signal(const World& world, const Cell& cell, const RuleSignals& signal,
                    std::int64_t interval);

/// Factors on the rates of exchange of a cell with a substance.
struct ExchangeFactors {
  double secretion = 1, uptake = 1;
};

/// Products of the responses of the rules of secretion and uptake of a substance; 1 without rules.
/// @param signal  of rule_signals; may be empty without such rules
ExchangeFactors exchange_factors(const RuleParams& params, int substance, int type,
                                 std::size_t index, const RuleSignals& signal);

/// Refreshes motility, force, heading and adhesion before a step, from the fields at the cells'
/// centres, ages and measured signals. The relative difference of a concentration across a cell, d
/// = 2 R |grad c| / c, gives chemotaxis and heading the share d / (d + sensitivity).
void update_guidance(const Params& params, State& state);

}  // namespace acinus::coupling
