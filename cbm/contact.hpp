#pragma once
/// Contacts of spheres with each other and with the boundary: JKR with hysteresis, and their links.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "cbm/contact_workspace.hpp"
#include "cbm/params.hpp"
#include "cbm/state.hpp"
#include "cbm/stiffness_law.hpp"
#include "contact/boundary.hpp"
#include "contact/record.hpp"
#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"
#include "solve/system.hpp"

namespace acinus::cbm {

/// Number of neighbours of a cell in dense tissue, that of a close packing of spheres.
inline constexpr double kNeighbours = 12;

/// Relative overlap d of a cell: the sum over all its contacts, divided by the number of neighbours
/// in dense tissue. With twelve neighbours it is the mean of [VanLiedekerke2020, Eq. (22)]. With
/// other numbers it still measures crowding, and a new contact makes no jump
/// (decision 21). Where a law asks for the mean, the divisor is the number of contacts,
/// and both properties are lost.
double relative_overlap(const ContactWorkspace& work, std::size_t cell, const StiffnessLaw& law);

/// Adds one contact of a cell to its overlaps. @pre overlap_sum is not empty
void count_overlap(ContactWorkspace& work, std::size_t cell, double relative, double share);

/// Extremes over spheres that bound the reach of their contacts.
struct Extremes {
  double softest = std::numeric_limits<double>::infinity();  ///< kPa
  double largest = 0;                                        ///< um, radius; 0: no sphere
};

/// Largest separation of two adhering spheres before contact ends, um: a bound over all pairs and
/// over the boundary.
double largest_separation(std::span<const Params> params, const Extremes& spheres,
                          const contact::Boundary& boundary);
/// The same for the spheres of a state.
double largest_separation(const State& state, std::span<const Params> params,
                          std::span<const double> radius, const contact::Boundary& boundary);

/// Rebuild the neighbour list if a cell moved more than half the skin. @return true if it was
/// rebuilt
bool refresh_pairs(const ContactInput& in, ContactWorkspace& work,
                   const Ranks& ranks = Ranks::serial());

/// True if the modulus of any type depends on the overlaps.
bool has_correction(std::span<const Params> params);

/// Overlaps of pairs and with walls, each with its share. @pre refresh_pairs
void compute_overlaps(const ContactInput& in, ContactWorkspace& work);

/// Search for all contacts and evaluate their law at the current positions: force, stiffness max(0,
/// dF/d overlap) n n^T and friction gamma pi a^2 of every pair. Where a law corrects the modulus,
/// the stiffness of a pair is max(0, dF/d overlap) + C_i + C_j,
///   C_i = n_i / 12 max_j dF/dE^ dE^/dE~_i dE~_i/dd_i / (R_i + R_j),   n_i contacts of the cell
/// (of a wall dF/dE of its face, that counts E~ twice, over R_i; with n_i for the 12 where d is the
/// mean), a bound of the effect of the other contacts of both cells on this one: with E~ held fixed
/// long steps are unstable above d = 0.09. All actions of a contact of two cells are multiplied by
/// the larger of their strengths, so that spheres born into each other separate slowly, and those
/// of a contact with the boundary by the cell's own.
/// @pre compute_overlaps if has_correction, and the interface's overlaps are added
/// @param contacts  receives the completed contacts with the boundary
/// @param link      one per near pair, zero where not touching
void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts,
                   solve::PointLinks& link);

/// Last stage of find_contacts: adds the coupling of its cells to the stiffness of every contact.
/// @pre work.coupling is known of every cell that has a contact, or empty
void add_coupling(ContactWorkspace& work, std::span<contact::Contact> obstacle,
                  std::span<solve::PointLink> link);

/// Adds the forces of find_contacts, and force and link of contacts with the boundary except moving
/// vessels. @pre the point links are those of find_contacts
void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       const contact::ContactList& contacts, solve::System& system);

/// Appends force and link of every contact with moving vessels.
void add_vessel_loads(const ContactInput& in, const contact::ContactList& contacts,
                      solve::Links& links);

/// Adds friction with the medium over the free area, 4 pi R^2 - sum pi a^2 >= 0, or over the whole
/// surface (Params::whole_medium_area) [VanLiedekerke2020, Eq. (19)], and the force on each cell as
/// a whole.
/// @param cell_force [n_cell] nN
void add_cell_loads(const ContactInput& in, const ContactWorkspace& work,
                    std::span<const Vec3> cell_force, solve::System& system);

/// Share of a sphere's surface that is always free: contact areas of spheres overlap and can add up
/// to more than the surface, but a cell without any friction could move at any speed.
inline constexpr double kLeastFree = 0.01;

/// Friction coefficient of one cell with the medium, nN s/um.
double medium_friction(const Params& p, double radius, double contact_area);

}  // namespace acinus::cbm
