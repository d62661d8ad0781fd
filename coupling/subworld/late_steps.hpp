#pragma once
/// Steps of late cells in a subworld, among neighbours with the velocity of the whole step.

#include "coupling/step/late_cells.hpp"

namespace acinus::coupling {

/// Steps of late cells of a world. Of first order like the step itself: the neighbours move as they
/// did with the late cells in one step. World and workspace outlive it.
LateSteps late_steps(World& world, Workspace& work);

}  // namespace acinus::coupling
