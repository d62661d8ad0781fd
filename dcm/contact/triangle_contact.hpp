#pragma once
/// Contacts of deformable cells triangle by triangle: the law of the model paper, Maugis-Dugdale
/// (contact/maugis_triangles.hpp), for scenes that select it for comparison.
///
/// Two triangles have up to two contacts, one where the stress between them is repulsive and one
/// where it is attractive, each with the area of that stress. Both have places on both triangles,
/// like all other contact records. Unlike points, which probe from both sides, triangles are paired
/// once, from the cell with the lower number. Search and law are one here; friction, which depends
/// on the areas, is added with the loads. Contacts of a cell with itself and with the boundary keep
/// the law of points.

#include <vector>

#include "contact/curved_triangle.hpp"
#include "contact/record.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Search for all contacts between the surfaces of cells, written in order of side a with force,
/// slope and area. Cost: all pairs of triangles within the boxes of two cells are visited.
/// @pre refresh_lists, for contacts of cells with themselves
void find_triangle_contacts(const ContactInput& in, ContactWorkspace& work,
                            std::vector<contact::Contact>& out);

/// Add each contact's share of the area of its triangles to work.share, on sides a and b: all
/// points of a triangle have the share of the triangle.
void add_triangle_shares(const contact::ContactList& contacts, ContactWorkspace& work);

/// Complete a contact between triangles and write its link.
void complete_triangle_contact(const ContactInput& in, const ContactWorkspace& work,
                               contact::Contact& contact, solve::Link& link, solve::LinkLoad& load);

/// Add the force remainders that links lack because their places are rounded: 1e-7 of each force,
/// moved between the corners on side b to the place along the normal from side a. The moment of a
/// contact is then zero to double precision.
void add_place_remainders(const ContactInput& in, const ContactWorkspace& work,
                          const contact::ContactList& contacts, std::vector<double>& force);

}  // namespace acinus::dcm
