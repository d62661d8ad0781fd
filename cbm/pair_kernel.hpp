#pragma once
/// Contacts of sphere pairs, eight at a time.

#include <vector>

#include "cbm/contact_workspace.hpp"
#include "contact/record.hpp"
#include "solve/system.hpp"

namespace acinus::cbm {

/// Evaluate every near pair: forces on the cells, contact areas and overlaps, links, and the new
/// touching set. First stage of find_contacts; clears the arrays that it writes.
void find_pair_contacts(const ContactInput& in, ContactWorkspace& work,
                        std::vector<solve::PointLink>& link);

/// Appends the touching pairs of the last search one by one. @pre find_contacts
void list_pairs(const ContactInput& in, const ContactWorkspace& work,
                contact::ContactList& contacts);

}  // namespace acinus::cbm
