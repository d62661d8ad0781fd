#pragma once
/// Contact of a sphere whose modulus follows a law with a vessel: the sphere stiffens by the
/// overlap with the vessel alone, and the wall yields no deeper than under deformable cells.
///
/// A vessel is no neighbour in d, and crowded neighbours may be a hundred times as stiff as the
/// sphere between them and the vessel. Without these two terms they press its centre through the
/// wall. Measured: docs/calibration.md.

#include "cbm/stiffness_law.hpp"
#include "core/contact/boundary.hpp"
#include "core/contact/hertz.hpp"

namespace acinus::cbm {

/// Pair for the contact law, and the change of its modulus with the overlap.
struct VesselPair {
  contact::SpherePair pair;
  double modulus_by_overlap = 0;  ///< dE^/d overlap at constant d, kPa/um, not negative
  bool own = false;               ///< the overlap with the vessel alone sets the sphere's modulus
};

/// The modulus of the sphere is the larger of that of its crowd and, beyond the range of the law,
/// that of the overlap over the sum of both radii (modulus_toward). With s = (1 - nu^2) / E of cell
/// and vessel, the wall takes the share s_vessel / (s_cell + s_vessel) of the overlap up to y =
/// yield_limit; from there on the cell takes the rest, so E^ = (1 - y / overlap) / s_cell, which is
/// continuous.   [decisions 22, 29]
/// @param cell      with the modulus of its crowd
/// @param vessel    with its radius at the contact
/// @param overlap   um
/// @param adhesion  nN/um
VesselPair corrected_vessel_pair(const StiffnessLaw& law, double young, const Modulus& crowd,
                                 const contact::SphereBody& cell, const contact::Material& vessel,
                                 double vessel_radius, double overlap, double adhesion);

}  // namespace acinus::cbm
