#pragma once
/// Contacts of pairs of cells in an assembled state.

#include <functional>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Net forces per pair of a deformable cell and a sphere, over all processes.
/// @pre assemble
std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& work);

/// Calls `visit` with a record of every contact between two spheres.   @pre assemble
void visit_sphere_pairs(const World& world, const Workspace& work,
                        const std::function<void(const contact::Contact&)>& visit);

/// Stencil of the unknowns of both sides of a contact.   @pre assemble
solve::Stencil stencil_of(const World& world, const Workspace& work,
                          const contact::Contact& contact);

}  // namespace acinus::coupling
