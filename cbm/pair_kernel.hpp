#pragma once
/// Contacts of sphere pairs, eight at a time.

#include <functional>
#include <vector>

#include "cbm/contact_workspace.hpp"
#include "contact/record.hpp"
#include "solve/system.hpp"

namespace acinus::cbm {

/// Evaluate every near pair: forces on the cells, contact areas and overlaps, links, and the new
/// touching set. First stage of find_contacts; clears the arrays that it writes.
void find_pair_contacts(const ContactInput& in, ContactWorkspace& work, solve::PointLinks& link);

/// Calls `visit` with a record of every touching pair of the last search. @pre find_contacts
void visit_pairs(const ContactInput& in, const ContactWorkspace& work,
                 const std::function<void(const contact::Contact&)>& visit);

}  // namespace acinus::cbm
