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

/// Overlap below which no ring exists, um.
double ring_end(const MaugisPair& pair) {
  const double s = rim_rise(pair);
  return -range_of(pair) - 0.5 * pair.pair.radius * s * s;
}

/// State without contact; c is the larger root, the other one is unstable.
MaugisPoint ring_at_overlap(const MaugisPair& pair, double overlap) {
  const double R = pair.pair.radius, s = rim_rise(pair);
  const double c = R * (s + std::sqrt(std::max(0.0, s * s + 2.0 * (range_of(pair) + overlap) / R)));
  return {0.0, c, overlap, -kPi * c * c * pair.cohesive_stress};
}

/// Reduced units of a pair.
struct ReducedUnits {
  double lambda, unit;
};
ReducedUnits units_of(const MaugisPair& pair) {
  return {maugis_lambda(pair), maugis_radius_unit(pair.pair)};
}

/// Bound of A: that of JKR, whose approach A^2 - (2/3) sqrt(6 A) has the largest adhesive part.
double first_guess(double approach) {
  double a = std::sqrt(std::max(approach, 0.0)) + 1.39;
  for (int k = 0; k < 3; ++k) a = std::sqrt(std::max(approach + 1.633 * std::sqrt(a), 0.3));
  return a;
}

/// Largest A with the given approach; empty if the contact branch ends before.
///
/// In A alone: H follows from the approach, and the closure minus 1 grows and is convex beyond its
/// largest root. Newton's method falls onto that root from above; where it loses its slope or
/// passes A = 0 there is none.
std::optional<MaugisState> find_contact(double lambda, double approach, double guess) {
  constexpr int kMostSteps = 100;
  double a = guess;
  const double h_factor = 3.0 / (4.0 * lambda);
  for (int k = 0; k < kMostSteps; ++k) {
    const double h = h_factor * (a * a - approach);
    const MaugisClosure f = evaluate_closure(lambda, a, h);
    const double slope = f.by_a + f.by_h * 2.0 * h_factor * a;
    if (!(slope > 0.0)) return {};
    const double down = (f.value - 1.0) / slope;
    // A first guess below the root steps above it.
    if (k > 0 ? down <= 1e-14 * a : std::abs(down) <= 1e-14 * a) return maugis_state(lambda, a, h);
    a -= down;
    if (!(a > 0.0)) return {};
  }
  return {};  // at the end of the branch to rounding
}

/// Overlap below which there is no force in any case, um: the range, the rise of the rim and the
/// stretch of JKR together.
double farthest_overlap(const MaugisPair& pair, const ReducedUnits& units) {
  return ring_end(pair) - units.unit * units.unit / pair.pair.radius;
}

MaugisPoint point_at(const MaugisPair& pair, const ReducedUnits& units, double overlap,
                     double guess) {
  const SpherePair& p = pair.pair;
  const double unit = units.unit;
  const auto state = find_contact(units.lambda, overlap * p.radius / (unit * unit), guess);
  if (state)
    return {state->a * unit, state->c * unit, overlap, state->load * kPi * p.adhesion * p.radius};
  if (overlap < ring_end(pair) || maugis_turns(units.lambda)) return {0.0, 0.0, overlap, 0.0};
  return ring_at_overlap(pair, overlap);
}

MaugisPoint hertz_point(const SpherePair& pair, double overlap) {
  const SphereForce hertz = hertz_force(pair, overlap);
  return {hertz.contact_radius, hertz.contact_radius, overlap, hertz.force};
}

}  // namespace

MaugisPoint maugis_at_overlap(const MaugisPair& pair, double overlap) {
  return maugis_growth(pair, overlap, 0.0).now;
}

MaugisGrowth maugis_growth(const MaugisPair& pair, double overlap, double more) {
  if (pair.pair.adhesion == 0.0)
    return {hertz_point(pair.pair, overlap), hertz_point(pair.pair, overlap + more)};
  ACINUS_ASSERT(pair.cohesive_stress > 0.0);
  const ReducedUnits units = units_of(pair);
  if (overlap < farthest_overlap(pair, units)) return {{0, 0, overlap, 0}, {0, 0, overlap, 0}};
  const auto guess_at = [&](double x) {
    return first_guess(x * pair.pair.radius / (units.unit * units.unit));
  };
  const MaugisPoint now = point_at(pair, units, overlap, guess_at(overlap));
  if (more == 0.0) return {now, now};
  const double then = overlap + more;
  // The root moves little; below it Newton's method steps above it first.
  const double guess = now.contact_radius > 0 ? now.contact_radius / units.unit : guess_at(then);
  return {now, point_at(pair, units, then, guess)};
}

double least_overlap(const MaugisPair& pair) {
  if (pair.pair.adhesion == 0.0) return 0.0;
  const double turning = maugis_turning_radius(pair);
  const double end = maugis_at_radius(pair, turning).overlap;
  return turning > 0.0 ? end : std::min(end, ring_end(pair));
}

}  // namespace acinus::contact
