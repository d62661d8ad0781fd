#pragma once
/// Pair forces that fade after a change of model.

#include "coupling/world/cell_forces.hpp"
#include "coupling/world/fading_force.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Remaining share of a force, from 1 to 0. It falls with time, and with the relative displacement
/// of the two cells, since a substitute for a contact must not drive separated cells apart.
/// @param apart  um, present value of FadingForce::apart
double left_of(const FadingForce& f, double time, const Vec3& apart);

/// Adds the remaining fading forces at a time. A pair that lost a cell exerts none.
void add_fading_forces(const State& state, double time, CellForces& forces);

/// Keeps the remaining shares over displacements that forces did not cause.
/// @param before  the same cells, of either model
void keep_fading(const State& before, State& state);

/// Removes forces that have faded or lost a cell.
void forget_faded(State& state);

}  // namespace acinus::coupling
