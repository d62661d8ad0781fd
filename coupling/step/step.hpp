#pragma once
/// One step of the hybrid world, from its present state to the displacement that follows.

#include <string>

#include "coupling/step/acceptance.hpp"
#include "coupling/step/effort.hpp"
#include "coupling/step/system_loads.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Assembles the system of a step at a state: the first five stages of attempt_step.
/// @param at  positions of all cells
void assemble(const World& world, const State& at, double step, Workspace& work,
              const SystemTerms& terms = {});

/// The same at the present state.
void assemble(const World& world, double step, Workspace& work, const SystemTerms& terms = {});

/// Attempts one step with the integrator of the run. The displacement is left in Workspace::move.
///
/// Linearly implicit Euler, (Gamma/h + K) dx = F(x; t + h) of order 1, is the method of choice:
/// contacts make the dynamics piecewise smooth, where higher order does not pay
/// (docs/decisions/0012.md). With numerics.extrapolate F and K are taken at x + h v of the last
/// step, which removes the lag of steady motion (docs/decisions/0016.md). Explicit Euler and
/// Newton's method are there for comparison and for single cells without contacts.
/// @param first_try  no attempt at this step was rejected before
/// @param effort     takes the work of this attempt too
Assessment attempt_step(const World& world, double step, bool first_try, Workspace& work,
                        Effort& effort);

/// The name a scene uses: "linearly-implicit", "explicit-euler", "newton".
std::string name_of(Integrator integrator);

}  // namespace acinus::coupling
