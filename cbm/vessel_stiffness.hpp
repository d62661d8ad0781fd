#pragma once
/// Contact with a vessel of a sphere whose modulus follows a law: the sphere stiffens by the
/// overlap with the vessel alone, and the indentation of the wall is limited as under deformable
/// cells.
///
/// A vessel is no neighbour in d, and crowded neighbours may be a hundred times as stiff as the
/// sphere between them and the vessel. Without these two terms they press its centre through the
/// wall. (decision 43)

#include "cbm/stiffness_law.hpp"
#include "contact/hertz.hpp"
#include "contact/material.hpp"

namespace acinus::cbm {

/// Pair for the contact law, and the change of its modulus with the overlap.
struct VesselPair {
  contact::SpherePair pair;
  double modulus_by_overlap = 0;  ///< dE^/d overlap at constant d, kPa/um, not negative
};

/// Pair for a cell at a vessel. With s = (1 - nu^2) / E of cell and vessel, the wall takes the
/// share s_vessel / (s_cell + s_vessel) of the overlap up to y = yield_limit; beyond it the cell
/// takes the rest, so E^ = (1 - y / overlap) / s_cell, which is continuous.   [decisions 22, 29]
/// @param face      modulus_toward the vessel, at the overlap over the sum of both radii
/// @param cell      with that modulus
/// @param overlap   um
/// @param adhesion  nN/um
VesselPair corrected_vessel_pair(const FaceModulus& face, const contact::SphereBody& cell,
                                 const contact::Material& vessel, double vessel_radius,
                                 double overlap, double adhesion);

}  // namespace acinus::cbm
