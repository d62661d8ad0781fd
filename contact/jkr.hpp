#pragma once
/// Adhesive elastic spheres [Johnson1971], Eq. (20) and (21) of the model paper with their roots
/// corrected:
///     F     = 4 E a^3/(3 R) - sqrt(8 pi W E a^3)
///     delta = a^2/R - sqrt(2 pi W a/E)
/// The contact radius has a fold at a_d = (pi W R^2/(8 E))^(1/3). With y = sqrt(a/a_d) both are
/// polynomials,
///     F = (4 E a_d^3/(3 R)) (y^6 - 6 y^3),   delta = (a_d^2/R) (y^4 - 4 y),
/// and y >= 1 is the branch that is stable when the overlap is held. W = 0 is Hertz.

#include "contact/hertz.hpp"

namespace acinus::contact {

/// Force of a pair at a given overlap, with hysteresis: contact starts at overlap >= 0 and lasts
/// while overlap >= -3 a_d^2/R. The touching flag is the caller's state and must be saved with it.
/// Newton on y - 1 from above the root of a convex function: monotone, cannot fail, 2 to 4
/// iterations. Radius and force are within 2e-15 of the larger of the force's two terms, except at
/// the fold: there a turns vertical over the overlap and round-off e of the overlap leaves sqrt(e)
/// of a. Stiffness: dF/d delta = 2 E a (y^3 - 3)/(y^3 - 1) is negative for y^3 < 3 and minus
/// infinity at the fold. Below y = 1.25 it is replaced by the chord from the fold to the pull-off
/// minimum, -3.424 E a_d, which force_by_modulus then uses as well. A NaN overlap gives a NaN
/// force, not a lost contact. About 7 million calls/s on a 2.5 GHz core.
/// @param overlap  delta = R_a + R_b - distance, um
/// @pre radius and modulus positive and finite, adhesion >= 0 (asserted)
SphereForce jkr_force(const SpherePair& pair, double overlap, bool was_touching);

/// Point of the JKR curve, on either branch.
struct JkrPoint {
  double contact_radius;  ///< um
  double overlap;         ///< um
  double force;           ///< nN, positive = repulsive
};

/// Point of Eq. (20) and (21) at a given contact radius (um, >= 0).
JkrPoint jkr_at_radius(const SpherePair& pair, double contact_radius);

/// Equilibrium overlap of a pair under a fixed load, um: the inverse of Eq. (20) and (21) on the
/// branch that is stable under load. A tension beyond the pull-off force gives the overlap at
/// pull-off.
/// @param force  nN, positive = pressed together
double jkr_overlap(const SpherePair& pair, double force);

/// Elastic plus surface energy in fJ against separated spheres; dU/d delta = F along the curve.
/// U = 8 E a^5/(15 R^2) - (4/3) sqrt(2 pi W E) a^(7/2)/R + pi W a^2
double jkr_energy(const SpherePair& pair, double contact_radius);

/// Characteristic points of the JKR curve.
struct JkrSpecial {
  JkrPoint fold;          ///< contact ends here: least overlap -3 a_d^2/R, force -(5/6) pi W R
  JkrPoint pull_off;      ///< least force, -(3/2) pi W R (Eq. 24): contact ends here at fixed load
  JkrPoint zero_overlap;  ///< force on first contact
  JkrPoint zero_force;    ///< equilibrium of a free pair
  double dmt_force;       ///< -2 pi W R, the limit of stiff small spheres
  double vesicle_force;   ///< -pi W R, the limit of a tense membrane
};
JkrSpecial jkr_special(const SpherePair& pair);

}  // namespace acinus::contact
