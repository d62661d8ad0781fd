#pragma once
/// Contacts of deformable cells with walls and vessels, and their guards (contact_points.hpp).

#include <vector>

#include "dcm/contact/contact_workspace.hpp"

namespace acinus::dcm {

/// Appends those of one body.
/// @param range  um, largest gap of interest
void find_obstacle_contacts(const ContactInput& in, const ContactWorkspace& work, int number,
                            double range, std::vector<contact::Contact>& out);

/// Takes the contacts with the surface of vessels, which is searched for with the static meshes,
/// out of those of surfaces: find_obstacle_contacts gives them what vessels are.
void take_wall_contacts(const ContactInput& in, ContactWorkspace& work,
                        std::vector<contact::Contact>& all);

}  // namespace acinus::dcm
