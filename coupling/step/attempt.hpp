#pragma once
/// Outcome of one attempt at a step.

#include "core/error.hpp"

namespace acinus::coupling {

/// The displacement is in Workspace::move.
struct Attempt {
  Status status;
  int cg_iterations = 0;
  int solves = 0;  ///< linear systems
};

}  // namespace acinus::coupling
