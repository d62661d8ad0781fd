#pragma once
/// Search for the contacts of deformable cells with each other and with the boundary.

#include <vector>

#include "contact/record.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Largest gap at which a contact of this cell has an effect, um.
double contact_range(const ContactParams& c, const geometry::Topology& t, double radius);

/// Rebuild the lists that no longer hold (contact_lists.hpp). @pre refresh_bodies
void refresh_lists(const ContactInput& in, ContactWorkspace& work);

/// Search for all contacts between surfaces and of surfaces with the boundary. Starts the list of
/// contacts with them and computes each point's touching share.
void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts);

/// Area of each node in contact with the medium, [n_row][lane] um^2: that without contact with
/// neighbours, or all of it (whole_medium_area). @pre all shares are known
void compute_medium_areas(const ContactInput& in, const ContactWorkspace& work,
                          RowVector<double>& medium_area);

}  // namespace acinus::dcm
