#pragma once
/// Force and torque balance of a step.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Force balance of the step just solved.   @pre work.rhs, work.move, work.cg.residual
Balance measure_balance(const World& world, Workspace& work);

}  // namespace acinus::coupling
