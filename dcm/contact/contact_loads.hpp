#pragma once
/// Links of contacts: the force, stiffness and friction of each.

#include "contact/record.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// Scale that keeps the touching areas of one point from adding up to more than its area.
inline double share_scale(double total_share) { return total_share > 1 ? 1 / total_share : 1; }

/// Friction coefficient of a contact of two cells, nN s/um^3 of its point's area. Half the area
/// counts, since the contact is found from both sides. @pre all shares are known
double cell_friction_at(const ContactParams& c, const ContactWorkspace& work,
                        const contact::Contact& contact);

/// Complete the contacts of surfaces with each other and with the boundary, and add a link for
/// each. Cell-cell contacts are found from both sides and carry half the weight each. Friction
/// between cells is added for FrictionForm::kSurface only.
void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       contact::ContactList& contacts, solve::Links& links);

}  // namespace acinus::dcm
