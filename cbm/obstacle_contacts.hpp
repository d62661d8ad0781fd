#pragma once
/// Contacts of spheres with walls, vessels and static meshes.

#include <vector>

#include "cbm/contact_workspace.hpp"
#include "contact/record.hpp"

namespace acinus::cbm {

/// Search for the contacts of spheres with the boundary: appends them, complete, and adds their
/// areas, couplings and touching flags to `work`. Second stage of find_contacts.
void find_obstacle_contacts(const ContactInput& in, ContactWorkspace& work,
                            contact::Contacts& contacts);

}  // namespace acinus::cbm
