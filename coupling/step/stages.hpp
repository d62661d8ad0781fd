#pragma once
/// The stages of a step up to the system of equations, in their order. None of them touches State.

#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Sizes everything for the present set of cells. Call after the set changed and before the first
/// step.
void size_workspace(const World& world, Workspace& work);

/// Stages 1 to 4: reference values at the end of the step, constrained cells, leaders, and the
/// contacts of the present positions.
void find_all_contacts(const World& world, double step, Workspace& work);

/// What to assemble.
struct Selection {
  bool interface = true;       ///< tests look at one model with and without it
  double stiffness_scale = 1;  ///< 0: friction only
};

/// Stage 5: both models, the interface and the constraint add their loads to one system.
void assemble(const World& world, double step, Workspace& work, Selection selection = {});

/// Forces between deformable cells and spheres, per pair of cells.   @pre assemble
std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& work);

/// Lists the contacts between spheres, which a step does not need one by one.
/// @pre find_all_contacts
void list_sphere_pairs(const World& world, Workspace& work);

/// The unknowns of both sides of a contact.   @pre find_all_contacts
solve::Stencil stencil_of(const World& world, const Workspace& work,
                          const contact::Contact& contact);

}  // namespace acinus::coupling
