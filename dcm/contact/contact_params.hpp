#pragma once
/// Constants of the contact of deformable cells.

#include "contact/surface.hpp"

namespace acinus::dcm {

/// Places between which the friction of two cells acts.
enum class FrictionForm {
  kSurface,  ///< a contact point and the closest place of the other surface
  kNodes     ///< the nodes of both triangles (node_friction.hpp)
};

/// Law of repulsion and adhesion between two deformable cells.
enum class ContactLaw {
  kCohesive,      ///< cohesive potential of the gap at contact points (contact/cohesive.hpp)
  kMaugisDugdale  ///< the paper's law between triangles (triangle_contact.hpp)
};

/// Constants of the surface contact, the same for all cells.
struct ContactParams {
  ContactLaw law = ContactLaw::kCohesive;
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double repulsion = 5;         ///< nN/um^3, k_rep
  double range_factor = 0.3;    ///< cohesive range in mean reference edges of the point's owner
  double friction_range = 0.3;  ///< um, independent of the mesh
  double max_depth = 1.5;       ///< um
  double skin = 0.3;            ///< um
  double cell_friction = 50;    ///< nN s/um^3, cell-cell
  FrictionForm friction_form = FrictionForm::kSurface;
  double adhesion_factor = 1;  ///< ramps up after start-up
  double friction_factor = 1;  ///< 0 while cells grow to size
  /// True if the medium acts on the whole surface, false if on the part without contacts.
  bool whole_medium_area = false;
  // For Maugis-Dugdale alone:
  double cohesive_range = 0.02;  ///< um, h0
  double modulus = 10;           ///< kPa, E^
  double max_radius = 50;        ///< um, R^ of surfaces that are flat or fit into each other
};

/// Gap kept between the folds of one surface, um.
inline constexpr double kSelfGap = 0.15;

}  // namespace acinus::dcm
