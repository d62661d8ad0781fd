#pragma once
/// List of the contacts of every pair with their areas.

#include <vector>

#include "coupling/measure/contact_sums.hpp"
#include "coupling/measure/measure.hpp"

namespace acinus::coupling {

/// Contacts of all cells with an area or a force, in the order of sum_contacts, over all processes.
/// @param cells  of measure_cells()   @pre observe
std::vector<CellContact> list_contacts(const World& world, const Workspace& work,
                                       const std::vector<CellMeasure>& cells);

}  // namespace acinus::coupling
