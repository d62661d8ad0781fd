#pragma once
/// Contact of a nucleus with the cortex around it, from inside.

#include <array>
#include <vector>

#include "contact/surface.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/links.hpp"

namespace acinus::dcm {

/// A point of the cortex and the nearest place of the nucleus. Only the cortex probes: the distance
/// from a round body to a point outside has a direction that changes smoothly, that from a node of
/// the nucleus to the hollow cortex around it jumps from face to face, and steps would chatter.
struct NucleusContact {
  std::size_t lane = 0;
  int point = 0;                  ///< of the cortex, contact::Quadrature::kThreePoint
  int triangle = 0;               ///< of the nucleus
  std::array<float, 2> weight{};  ///< of its first two corners
  Vec3 normal = Vec3::Zero();     ///< unit, d gap / d point
  double gap = 0;   ///< um, between the surfaces less that at which they begin to push
  double area = 0;  ///< um^2, what the point stands for
};

/// Scratch; sized by and empty without nuclei.
struct NucleusWorkspace {
  std::vector<contact::SurfaceBody> body;  ///< of the nuclei; written by: find_nucleus_contacts
  std::vector<std::size_t> cortex;         ///< [body] number of its cortex in the contact workspace
  std::vector<std::vector<NucleusContact>> found;  ///< [body]; likewise
};

/// How much farther apart than at contact, um, points are listed: a step may close the gap.
inline constexpr double kNucleusAhead = 0.5;

/// Finds the contacts of all nuclei whose cells move. @pre refresh_bodies
void find_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                           NucleusWorkspace& work);

/// Adds a link for each: E = 1/2 k a gap^2 where the gap is negative, force = -dE/d gap along the
/// normal, k = Nucleus::repulsion and a the area. Open ones have a link without force, so that a
/// step can close them. No friction: the links of the nucleus have it (nucleus_links.hpp).
void add_nucleus_contacts(const ContactInput& in, const ContactWorkspace& cortices,
                          const NucleusWorkspace& work, solve::Links& links);

/// Energy of a contact, fJ.
double nucleus_contact_energy(const Nucleus& n, const NucleusContact& contact);

}  // namespace acinus::dcm
