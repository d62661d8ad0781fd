#include "contact/maugis_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

namespace {

/// Displacement of the rim of a disc under the stress sigma0 over c, 4 sigma0/(pi E).
double rim_rise(const MaugisPair& pair) {
  return 4.0 * pair.cohesive_stress / (kPi * pair.pair.modulus);
}

double range_of(const MaugisPair& pair) { return pair.pair.adhesion / pair.cohesive_stress; }

/// State without contact; c is the larger root, the other one is unstable.
MaugisPoint ring_at_overlap(const MaugisPair& pair, double overlap) {
  const double R = pair.pair.radius, s = rim_rise(pair);
  const double c =
      R * (s + std::sqrt(std::max(0.0, s * s + 2.0 * (range_of(pair) + overlap) / R)));
  return {0.0, c, overlap, -kPi * c * c * pair.cohesive_stress};
}

/// Largest A with the given approach; empty if the contact branch ends before.
///
/// In A alone: H follows from the approach, and the closure minus 1 grows and is convex beyond its
/// largest root. Newton's method falls onto that root from above; where it loses its slope or
/// passes A = 0 there is none.
std::optional<MaugisState> find_contact(double lambda, double approach) {
  constexpr int kMostSteps = 100;
  // Bound of A from JKR's approach = A^2 - (2/3) sqrt(6 A), the largest adhesive part of all lambda.
  double a = std::sqrt(std::max(approach, 0.0)) + 1.39;
  const double h_factor = 3.0 / (4.0 * lambda);
  for (int k = 0; k < kMostSteps; ++k) {
    const double h = h_factor * (a * a - approach);
    const MaugisClosure f = evaluate_closure(lambda, a, h);
    const double slope = f.by_a + f.by_h * 2.0 * h_factor * a;
    if (!(slope > 0.0)) return {};
    const double down = (f.value - 1.0) / slope;
    if (down <= 1e-14 * a) return maugis_state(lambda, a, h);
    a -= down;
    if (!(a > 0.0)) return {};
  }
  return {};  // at the end of the branch to rounding
}

}  // namespace

MaugisPoint maugis_at_overlap(const MaugisPair& pair, double overlap) {
  const SpherePair& p = pair.pair;
  if (p.adhesion == 0.0) {
    const SphereForce hertz = hertz_force(p, overlap);
    return {hertz.contact_radius, hertz.contact_radius, overlap, hertz.force};
  }
  ACINUS_ASSERT(pair.cohesive_stress > 0.0);
  const double unit = maugis_radius_unit(p), lambda = maugis_lambda(pair);
  const auto state = find_contact(lambda, overlap * p.radius / (unit * unit));
  if (state)
    return {state->a * unit, state->c * unit, overlap, state->load * kPi * p.adhesion * p.radius};
  if (maugis_turns(lambda) || overlap < least_overlap(pair)) return {0.0, 0.0, overlap, 0.0};
  return ring_at_overlap(pair, overlap);
}

double least_overlap(const MaugisPair& pair) {
  const SpherePair& p = pair.pair;
  if (p.adhesion == 0.0) return 0.0;
  const double lambda = maugis_lambda(pair);
  if (maugis_turns(lambda)) return maugis_at_radius(pair, maugis_turning_radius(pair)).overlap;
  const double s = rim_rise(pair);
  return std::min(maugis_at_radius(pair, 0.0).overlap, -range_of(pair) - 0.5 * p.radius * s * s);
}

}  // namespace acinus::contact
