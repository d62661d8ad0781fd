#pragma once
/// One attempt at a step, by the method of the run. The displacement follows from the state alone;
/// acceptance.hpp decides about it.
///
/// Linearly implicit Euler is the method of choice: contacts make the dynamics piecewise smooth,
/// where higher order does not pay (docs/decisions/0012.md). The others are there to compare with
/// and for equilibria.

#include <string>

#include "coupling/step/attempt.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Tries one step of this length with the method of the run.
/// @param first_try  no attempt at this step was rejected before
/// @post world is as before
Attempt attempt_step(World& world, double step, bool first_try, Workspace& work);

/// The name a scene uses: "linearly-implicit", "explicit-euler", "newton".
std::string name_of(Integrator integrator);

}  // namespace acinus::coupling
