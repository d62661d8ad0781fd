#pragma once
/// Ways to take one step. Each works out the displacement of a step from the state alone; whether
/// it is any good is judged elsewhere.
///
/// Linearly implicit Euler is the method of choice: contacts make the dynamics piecewise smooth,
/// where higher order does not pay (docs/decisions/0012.md). The others are there to compare with
/// and for single cells without contacts.

#include <string>

#include "core/error.hpp"
#include "coupling/world.hpp"

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
///   linearly implicit:  (Gamma/h + K) dx = F(x; t + h), order 1
///   explicit Euler:     (Gamma/h) dx = F(x; t), the friction solve of [VanLiedekerke2020], order 1
///   ROS2:               two stages with one matrix, Gamma/(g h) + K, g = 1 - 1/sqrt 2, order 2 for
///                       any K [Verwer1999, Eq. (1.3)]
///   Newton:             Gamma/h dx = F(x + dx; t + h) by Newton with line search, order 1
/// With `extrapolate` and `first_try` the linearly implicit method takes F and K at x + h v of the
/// last step, which takes the lag out of steady motion (docs/decisions/0016.md); not after a jump
/// of the random force, whose velocity is gone.
/// @post world is as before
Attempt attempt_step(World& world, double step, bool first_try, Workspace& work);

/// The name a scene uses: "linearly-implicit", "explicit-euler", "ros2", "newton".
std::string name_of(Integrator integrator);

}  // namespace acinus::coupling
