#pragma once
/// Pair forces that fade after a change of model.

#include "coupling/world/cell_forces.hpp"
#include "coupling/world/fading_force.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// What is left of a force, from 1 to 0. It fades with time, and with the way of the two relative
/// to each other: what stands in for a contact must not drive cells away that have come apart.
/// @param apart  um, as FadingForce::apart, now
double left_of(const FadingForce& f, double time, const Vec3& apart);

/// Adds what is left of the forces at a time. A pair of which one cell is gone exerts none.
void add_fading_forces(const State& state, double time, CellForces& forces);

/// Leaves as much of the forces as there was before cells were moved by something else than forces.
/// @param before  the same cells, of either model
void keep_fading(const State& before, State& state);

/// Removes those that have faded or lost a cell.
void forget_faded(State& state);

}  // namespace acinus::coupling
