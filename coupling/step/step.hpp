#pragma once
/// One step of the hybrid world: from its present state to a displacement.

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

/// Assembles at the present state.
void assemble(const World& world, double step, Workspace& work, const SystemTerms& terms = {});

/// Attempts one step with the integrator of the run. Leaves the displacement in Workspace::move.
///
/// Linearly implicit Euler, (Gamma/h + K) dx = F(x; t + h), of first order, is the default:
/// contacts make the dynamics piecewise smooth, where higher order does not pay
/// (decision 12). With numerics.extrapolate F and K are evaluated at the predictor x + h
/// v with the velocity of the last step, which removes the lag of steady motion
/// (decision 16). Explicit Euler and Newton's method serve comparisons and single cells
/// without contacts.
/// @param first_try  true unless an attempt at this step was rejected
/// @param effort     counters that the work of this attempt is added to
Assessment attempt_step(const World& world, double step, bool first_try, Workspace& work,
                        Effort& effort);

/// Name in scenes: "linearly-implicit", "explicit-euler", "newton".
std::string name_of(Integrator integrator);

}  // namespace acinus::coupling
