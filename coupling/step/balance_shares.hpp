#pragma once
/// Dynamic load balancing: measures the cost of cells and partitions them anew.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Measures load imbalance at intervals of steps and repartitions the cells if it is too large.
/// Call it after every accepted step.
void balance_shares(World& world, Workspace& work);

}  // namespace acinus::coupling
