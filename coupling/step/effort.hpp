#pragma once
/// Work spent on the attempts at a step.

namespace acinus::coupling {

struct Effort {
  int cg_iterations = 0;
  int solves = 0;         ///< linear systems
  int longest_solve = 0;  ///< iterations
};

}  // namespace acinus::coupling
