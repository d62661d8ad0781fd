#pragma once
/// Sphere pairs, eight at a time.

#include "cbm/contact.hpp"

namespace acinus::cbm {

/// Evaluates every near pair: forces on the cells, contact areas and overlaps, links, and the new
/// touching set. The first of the stages of find_contacts; clears what it writes.
void find_pair_contacts(const ContactInput& in, ContactWorkspace& work,
                        std::vector<solve::PointLink>& link);

}  // namespace acinus::cbm
