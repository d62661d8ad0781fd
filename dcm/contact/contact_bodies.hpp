#pragma once
/// Bodies of deformable cells in the contact search. Those of ghost cells are incomplete until
/// needed.

#include <span>

#include "dcm/contact/contact_workspace.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Copy the nodes from the lanes and recompute normals and boxes; for ghost bodies the boxes alone.
void refresh_bodies(const State& state, ContactWorkspace& work);

/// Complete the ghost bodies among `bodies`, which may hold repetitions. @pre refresh_bodies
void complete_bodies(const State& state, std::span<const int> bodies, ContactWorkspace& work);

/// Copy the nodes of incomplete bodies, for measures that need all of them. @pre refresh_bodies
void copy_all_nodes(const State& state, ContactWorkspace& work);

}  // namespace acinus::dcm
