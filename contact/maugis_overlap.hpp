#pragma once
/// Maugis-Dugdale curve as a function of overlap instead of contact radius. At large lambda several
/// equilibrium states exist at one overlap. The one with the largest contact is used, that of
/// bodies being separated, so the force has no memory and jumps where that branch ends.

#include "contact/maugis.hpp"

namespace acinus::contact {

/// Pair and the ends of its curve.
struct MaugisCurve {
  MaugisPair pair;             ///< adhesion 0: Hertz
  double lambda = 0;           ///< Eq. (15)
  double least_radius = 0;     ///< um, a at the end of the contact branch, 0 if the curve goes on
  double contact_overlap = 0;  ///< um, overlap there
  double least_overlap = 0;    ///< um, overlap below which there is no force
};
MaugisCurve make_maugis_curve(const MaugisPair& pair);

/// State at an overlap, um (negative: separated); all zero below the least one. In contact the
/// equations of maugis.hpp hold. Without contact (a = 0, attraction by the ring of radius c alone)
/// the gap at c is h0, which includes the displacement of the rim of a disc under the stress sigma0
/// [Maugis1992]:
///   c^2/(2 R) - 4 sigma0 c/(pi E) = h0 + delta,  P = -pi c^2 sigma0;
/// it continues the contact branch at a = 0 without a jump.
MaugisPoint maugis_at_overlap(const MaugisCurve& curve, double overlap);

}  // namespace acinus::contact
