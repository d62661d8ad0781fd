#pragma once
/// One attempt at a step, by the method of the run. It works out the displacement from the state
/// alone; whether that is accepted is decided elsewhere.
///
/// Linearly implicit Euler is the method of choice: contacts make the dynamics piecewise smooth,
/// where higher order does not pay (docs/decisions/0012.md). The others are there to compare with
/// and for single cells without contacts.

#include <string>

#include "core/error.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct Workspace;

/// What one attempt at a step came to; the displacement is in Workspace::move.
struct Attempt {
  Status status;
  int cg_iterations = 0;
  int solves = 0;     ///< linear systems
  double error = -1;  ///< um, the method's own estimate; negative: it has none
};

/// Tries one step of this length with the method of the run.
/// @param first_try  no attempt at this step was rejected before
/// @post world is as before
Attempt attempt_step(World& world, double step, bool first_try, Workspace& work);

/// The name a scene uses: "linearly-implicit", "explicit-euler", "ros2", "newton".
std::string name_of(Integrator integrator);

}  // namespace acinus::coupling
