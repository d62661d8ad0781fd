#pragma once
/// Stage 5 of a step: the linear system of all cells, from the loads of both models.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Terms of the assembled system.
struct SystemTerms {
  bool interface = true;   ///< contacts between the two models; false only in tests
  bool stiffness = true;   ///< false: friction only, for explicit methods
  bool end_values = true;  ///< references and walls at the end of the step, else its start
};

/// Assembles forces, friction and stiffness of cells, contacts, apparatus, vessels and
/// constraints.
/// @param at  positions of all cells
/// @pre contacts and cell forces are those of `at`
void add_loads(const World& world, const State& at, double step, const SystemTerms& terms,
               Workspace& work);

}  // namespace acinus::coupling
