#pragma once
/// Contacts of pairs of cells in an assembled state.

#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Net forces per pair of a deformable cell and a sphere, over all processes.
/// @pre assemble
std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& work);

/// Appends the contacts between spheres to the list; a step does not need them individually.   @pre
/// assemble
void list_sphere_pairs(const World& world, Workspace& work);

/// Removes them again, and gives back their memory.
void drop_sphere_pairs(Workspace& work);

/// Stencil of the unknowns of both sides of a contact.   @pre assemble
solve::Stencil stencil_of(const World& world, const Workspace& work,
                          const contact::Contact& contact);

}  // namespace acinus::coupling
