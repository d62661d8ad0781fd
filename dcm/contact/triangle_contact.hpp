#pragma once
/// Contacts of deformable cells triangle by triangle: the law of the model paper, Maugis-Dugdale
/// (contact/maugis_triangles.hpp), for scenes that select it.
///
/// A triangle has up to two contacts with a partner, one where the stress between them is repulsive
/// and one where it is attractive, each with the area of that stress. Both have places on the
/// triangle, and on that of side b if it has one, like all other contact records. Unlike points,
/// which probe from both sides, triangles are paired once, from the cell with the lower number. A
/// wall, a vessel or a sphere is met as the sphere that touches it at the place nearest to the
/// triangle [VanLiedekerke2020, section 2.1]. Search and law are one here; friction, which depends
/// on the areas, is added with the loads. Contacts of a cell with itself keep the law of points.

#include <limits>
#include <vector>

#include "contact/maugis_triangles.hpp"
#include "contact/record.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Elastic constants of a partner, beside those of the law: the reduced modulus of the pair is in
/// series with it.
struct PartnerSurface {
  double adhesion = 0;  ///< nN/um, W of the pair
  double modulus = 0;   ///< kPa, E/(1 - nu^2); infinite: rigid
  double most_yield = std::numeric_limits<double>::infinity();  ///< um, largest indentation
};
contact::MaugisLaw maugis_law(const ContactParams& options, const PartnerSurface& partner);

/// Largest distance of a triangle from a partner that exerts a force on it, um.
double maugis_reach(const contact::MaugisLaw& law, double max_depth);

/// The same of all cells, walls, vessels and static meshes.
double triangle_reach(const ContactInput& in);

/// Recompute the curved triangles of complete bodies that have none of the present time.
void refresh_curved_triangles(ContactWorkspace& work);

/// Search for all contacts between the surfaces of cells and with static meshes, written in order
/// of side a with force, slope and area.
/// @param reach  um, triangle_reach at present: lists may be older
/// @pre refresh_lists
void find_triangle_contacts(const ContactInput& in, ContactWorkspace& work, double reach,
                            contact::Contacts& out);

/// Search for the contacts of the triangles of one body with walls and vessels; appends them.
/// @param reach  um
/// @pre find_triangle_contacts
void find_triangle_obstacles(const ContactInput& in, const ContactWorkspace& work, int body,
                             double reach, contact::Contacts& out);

/// Append the contacts of one triangle with an object.
/// @param like    sides of the contact, without places
/// @param center  of a ball, through which the force acts so that it has no moment; null: none
void add_object_contacts(const contact::MaugisLaw& law, const contact::CurvedTriangle& triangle,
                         const contact::SphericalCap& object, const contact::Contact& like,
                         const Vec3* center, contact::Contacts& out);

/// Add each contact's share of the area of its triangles to work.share, on side a and on side b if
/// that is a cell: all points of a triangle have the share of the triangle.
void add_triangle_shares(std::span<const contact::Contact> contacts, ContactWorkspace& work);

/// Complete a contact of a triangle and write its link, but for side b.
/// @param friction  nN s/um^3
void complete_triangle_contact(const ContactInput& in, const ContactWorkspace& work,
                               double friction, contact::Contact& contact, solve::Link& link,
                               solve::LinkLaw& law);

/// Add the force remainders that links lack because their places are rounded: 1e-7 of each force,
/// moved between the corners on side b to the place along the normal from side a. The moment of a
/// contact is then zero to double precision.
void add_place_remainders(const ContactInput& in, const ContactWorkspace& work,
                          const contact::ContactList& contacts, std::span<double> force);

}  // namespace acinus::dcm
