#pragma once
/// Contacts of deformable cells triangle by triangle: the law of the model paper, Maugis-Dugdale
/// (contact/maugis_triangles.hpp), for scenes that choose it to compare with.
///
/// Two triangles have up to two contacts, one where the stress between them pushes and one where it
/// pulls, each with the area of that stress. Both are places on both triangles, so that all that
/// reads contacts reads these as well. Unlike points, which probe from both sides, triangles are
/// met once, from the cell with the lower number. Search and law are one here; what remains to be
/// done with the loads is friction, which rubs with the areas. Contacts of a cell with itself, and
/// with boundary, keep the law of points.

#include <vector>

#include "contact/curved_triangle.hpp"
#include "contact/record.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Writes all contacts between the surfaces of cells, in order of side a, with force, slope and
/// area. Cost: all pairs of triangles within the boxes of two cells are looked at.
/// @pre refresh_lists, for contacts of cells with themselves
void find_triangle_contacts(const ContactInput& in, ContactWorkspace& work,
                            std::vector<contact::Contact>& out);

/// Adds each contact's share of the area of its triangles to work.share, side a and side b: all
/// points of a triangle have the share of the triangle.
void add_triangle_shares(const contact::ContactList& contacts, ContactWorkspace& work);

/// Completes one of them and writes its link.
void complete_triangle_contact(const ContactInput& in, const ContactWorkspace& work,
                               contact::Contact& contact, solve::Link& link, solve::LinkLoad& load);

/// Adds what links leave out, for the places they keep are rounded: 1e-7 of each force, moved
/// between the corners on side b to where side a is along the normal. The moment of a contact then
/// is zero to the rounding of numbers in double precision.
void add_place_remainders(const ContactInput& in, const ContactWorkspace& work,
                          const contact::ContactList& contacts, std::vector<double>& force);

}  // namespace acinus::dcm
