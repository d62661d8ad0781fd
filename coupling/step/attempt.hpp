#pragma once
/// Outcome of one attempt at a step.

#include "core/error.hpp"

namespace acinus::coupling {

/// The displacement is in Workspace::move.
struct Attempt {
  Status status;
  int cg_iterations = 0;
  int solves = 0;     ///< linear systems
  double error = -1;  ///< um, the method's own estimate; negative: it has none
};

}  // namespace acinus::coupling
