#pragma once
/// Maugis-Dugdale curve as a function of overlap instead of contact radius. At large lambda several
/// equilibrium states exist at one overlap. The one with the largest contact is used, that of
/// bodies being separated, so the force has no memory and jumps where that branch ends.

#include "contact/maugis.hpp"

namespace acinus::contact {

/// State at an overlap, um (negative: separated); all zero where no state exists. In contact the
/// equations of maugis.hpp hold; Newton's method from above finds the largest root. Without contact
/// (a = 0, attraction by the ring of radius c alone) the gap at c is h0, which includes the
/// displacement of the rim of a disc under the stress sigma0 [Maugis1992]:
///   c^2/(2 R) - 4 sigma0 c/(pi E) = h0 + delta,  P = -pi c^2 sigma0;
/// it continues the contact branch at a = 0 without a jump. Adhesion 0: Hertz.
MaugisPoint maugis_at_overlap(const MaugisPair& pair, double overlap);

/// States at an overlap and at one that is larger by `more`, um, for the growth of the stress.
struct MaugisGrowth {
  MaugisPoint now, then;
};
MaugisGrowth maugis_growth(const MaugisPair& pair, double overlap, double more);

/// Least overlap with a force, um: negative with adhesion.
double least_overlap(const MaugisPair& pair);

}  // namespace acinus::contact
