#pragma once
/// Point of linearisation of a step: the present positions, or those that the last step's velocity
/// leads to.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Chooses the point of linearisation: linearly implicit steps extrapolate all cells if the run
/// asks for it and the motion is steady, and cells with a prescribed velocity always.
/// @param first_try  no attempt at this step was rejected before
/// @return the state to assemble at; it lives until the next call
const State& choose_linearisation_point(const World& world, double step, bool first_try,
                                        Workspace& work);

/// Computes the products of the assembled matrices with the displacement to the point of
/// linearisation.   @pre the system is that of the point, which is not the present state
void compute_point_products(Workspace& work);

}  // namespace acinus::coupling
