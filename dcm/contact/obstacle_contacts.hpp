#pragma once
/// Contacts of deformable cells and their guards (contact_points.hpp) with walls and vessels.

#include <vector>

#include "dcm/contact/contact_workspace.hpp"

namespace acinus::dcm {

/// Search for the contacts of one body with walls and vessels; appends them.
/// @param range  um, largest gap of interest
void find_obstacle_contacts(const ContactInput& in, const ContactWorkspace& work, int number,
                            double range, contact::Contacts& out);

/// Move the contacts with the surface of vessels from those of surfaces to `work`. They are found
/// with the static meshes; find_obstacle_contacts then completes them as contacts with vessels.
void take_wall_contacts(const ContactInput& in, ContactWorkspace& work, contact::Contacts& all);

}  // namespace acinus::dcm
