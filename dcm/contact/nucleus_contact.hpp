#pragma once
/// Contact of a nucleus with the inside of its cortex.
///
/// Contacts of ContactKind::kNucleus join a point of the cortex (contact::Quadrature::kThreePoint)
/// and the nearest place of the nucleus. The gap is that of the surfaces minus the one at which
/// repulsion begins. Only the cortex probes: the distance from a convex body to a point outside has
/// a direction that changes smoothly. That from a node of the nucleus to the concave cortex around
/// it jumps from face to face, and steps would chatter.

#include <vector>

#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// Scratch of nucleus contacts; empty without nuclei.
struct NucleusWorkspace {
  std::vector<contact::SurfaceBody> body;  ///< of the nuclei; written by: find_nucleus_contacts
  std::vector<std::size_t> cortex;         ///< [body] number of its cortex in the contact workspace
};

/// Skin of the search, um: gap beyond contact up to which points are listed, as a step may close
/// it.
inline constexpr double kNucleusSkin = 0.5;

/// Search for the contacts of all nuclei whose cells move; appends them. @pre refresh_bodies
void find_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                           NucleusWorkspace& work, contact::ContactList& contacts);

/// Completes the contacts and adds a link for each: E = 1/2 k a gap^2 where the gap is negative,
/// force = -dE/d gap along the normal, k = Nucleus::repulsion and a the area. Open ones have a link
/// without force, so that a step can close them. No friction: the links of the nucleus have it
/// (nucleus_links.hpp).
void add_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                          contact::ContactList& contacts, solve::Links& links);

/// Area that the point of a contact stands for, um^2.
double nucleus_contact_area(const ContactInput& in, const ContactWorkspace& cortices,
                            const contact::Contact& contact);

/// Energy of a contact, fJ.
/// @param area  um^2, of its point
double nucleus_contact_energy(const contact::Contact& contact, double area);

}  // namespace acinus::dcm
