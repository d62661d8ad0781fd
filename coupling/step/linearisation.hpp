#pragma once
/// Point of linearisation of a step: the present positions, or an extrapolated predictor from the
/// velocity of the last step.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Chooses the point of linearisation. Linearly implicit steps extrapolate all cells if the run
/// allows it and motion is steady. Cells with a prescribed velocity are always extrapolated.
/// @param first_try  true unless an attempt at this step was rejected
/// @return state to assemble at, valid until the next call
const State& choose_linearisation_point(const World& world, double step, bool first_try,
                                        Workspace& work);

/// Computes the friction between cells of the displacement to the point of linearisation.
/// @pre the system is assembled at that point, which differs from the present state
void compute_pair_friction(Workspace& work);

/// Computes the friction, nN, of the displacement to the point of linearisation into
/// work.cg.product, without penalty forces; with stiffness if not all cells are displaced.
/// @pre compute_pair_friction
void compute_point_friction(Workspace& work);

}  // namespace acinus::coupling
