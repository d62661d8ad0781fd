#pragma once
/// Cells around others that decide their contact forces.

#include "coupling/subworld/subworld.hpp"

namespace acinus::coupling {

/// Union and difference of two sets, ascending.
CellSet unite(const CellSet& a, const CellSet& b);
CellSet subtract(const CellSet& a, const CellSet& b);

/// Gap, um, beyond which two cells cannot interact, with a reserve for growth during a step.
/// Collective.
double contact_reach(const World& world);

/// Cells needed around others in their step: all contact candidates, and the neighbours of spheres
/// among these, whose stiffness depends on all their contacts.
CellSet find_ring(const World& world, const CellSet& cells);

}  // namespace acinus::coupling
