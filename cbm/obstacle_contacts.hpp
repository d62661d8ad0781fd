#pragma once
/// Contacts of spheres with planes, capsules, vessels and static meshes.

#include <vector>

#include "cbm/contact_workspace.hpp"
#include "contact/record.hpp"

namespace acinus::cbm {

/// Appends the contacts of spheres with boundary, complete, and adds their areas, couplings and
/// touching flags to `work`. The second of the stages of find_contacts.
void find_obstacle_contacts(const ContactInput& in, ContactWorkspace& work,
                            std::vector<contact::Contact>& contacts);

}  // namespace acinus::cbm
