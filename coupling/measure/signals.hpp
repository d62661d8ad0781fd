#pragma once
/// Measured signals of the rules of behaviour: pressure, volume, contacts and layers of cells.

#include <vector>

#include "coupling/measure/measure.hpp"

namespace acinus::coupling {

/// Measured signals, [rule][dcm lanes, then cbm cells]; empty for a rule whose signal is not
/// measured. Collective call.
/// @param cells  of measure_cells()   @pre observe
std::vector<std::vector<double>> measure_signals(const World& world, const Workspace& work,
                                                 const std::vector<CellMeasure>& cells);

/// Signals of all rules at present, concentrations and ages included, as measure_signals.
std::vector<std::vector<double>> present_signals(const World& world, const Workspace& work,
                                                 const std::vector<CellMeasure>& cells);

/// Measures the signals of the present positions if the time grid of life was crossed since they
/// were measured, or never. Nothing without a rule that needs them, and before t = 0.
void refresh_signals(World& world, Workspace& work);

}  // namespace acinus::coupling
