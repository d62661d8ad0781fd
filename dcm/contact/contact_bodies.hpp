#pragma once
/// Bodies of deformable cells as the contact search sees them: of ghost ones no more than is
/// needed.

#include <span>

#include "dcm/contact/contact_workspace.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Copies the nodes out of the lanes and recomputes normals and boxes; of ghost bodies only the
/// boxes.
void refresh_bodies(const State& state, ContactWorkspace& work);

/// Refreshes the ghost bodies among some in full, any number of times each. @pre refresh_bodies
void complete_bodies(const State& state, std::span<const int> bodies, ContactWorkspace& work);

/// Copies the nodes of the bodies that have none, for measures that need all of them.
/// @pre refresh_bodies
void copy_all_nodes(const State& state, ContactWorkspace& work);

}  // namespace acinus::dcm
