#pragma once
/// The Maugis-Dugdale curve asked by overlap instead of contact radius. Large lambda: at one
/// overlap several states are in balance; the one taken is that of bodies drawn apart (the largest
/// contact), so the force has no memory and ends with a jump where that branch ends.

#include "contact/maugis.hpp"

namespace acinus::contact {

/// A pair and where its curve ends.
struct MaugisCurve {
  MaugisPair pair;             ///< adhesion 0: Hertz
  double lambda = 0;           ///< Eq. (15)
  double least_radius = 0;     ///< um, a at the end of the branch in contact, 0 if it goes on apart
  double contact_overlap = 0;  ///< um, overlap there
  double least_overlap = 0;    ///< um, below it nothing holds
};
MaugisCurve make_maugis_curve(const MaugisPair& pair);

/// The state at an overlap, um (negative: apart); all zero below the least one. In contact the
/// closed set of maugis.hpp. Apart (a = 0, only the ring of radius c pulls) the gap at c is h0,
/// with what the stress sigma0 on a disc lifts its rim [Maugis1992]:
///   c^2/(2 R) - 4 sigma0 c/(pi E) = h0 + delta,  P = -pi c^2 sigma0;
/// it meets the branch in contact at a = 0 without a step.
MaugisPoint maugis_at_overlap(const MaugisCurve& curve, double overlap);

}  // namespace acinus::contact
