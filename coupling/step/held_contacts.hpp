#pragma once
/// Contacts of spheres in existence, which with several processes are with the owners of the
/// spheres: State::holder names them.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Hands contacts over to the present owners of their spheres; does nothing if these have them.
/// Collective.
/// @pre the blocks of the system are those of the state
void hand_over_contacts(const Ranks& ranks, const Workspace& work, State& state);

/// Gathers the contacts of all spheres on every process: before cells are taken into a subworld.
/// Collective.
void complete_contacts(const Ranks& ranks, State& state);

}  // namespace acinus::coupling
