#include "contact/maugis_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

namespace {

/// Root of f between low (f <= 0) and high (f > 0) by the Illinois method: false position that
/// halves the value at an end that stays.
template <class F>
double find_root(F f, double low, double high) {
  double f_low = f(low), f_high = f(high), x = low;
  for (int iteration = 0; iteration < 100 && high - low > 1e-15 * high; ++iteration) {
    const double previous = x;
    x = (low * f_high - high * f_low) / (f_high - f_low);
    const double value = f(x);
    if (value <= 0) {
      if (iteration > 0 && previous == low) f_high *= 0.5;
      low = x;
      f_low = value;
    } else {
      if (iteration > 0 && previous == high) f_low *= 0.5;
      high = x;
      f_high = value;
    }
    if (std::abs(x - previous) <= 1e-15 * x || value == 0) break;
  }
  return x;
}

/// Displacement of the rim of a disc under the stress sigma0 over c, 4 sigma0/(pi E).
double rim_rise(const MaugisPair& pair) {
  return 4.0 * pair.cohesive_stress / (kPi * pair.pair.modulus);
}

/// State without contact; c is the larger root, the other one is unstable.
MaugisPoint ring_at_overlap(const MaugisPair& pair, double overlap) {
  const double R = pair.pair.radius, s = rim_rise(pair);
  const double h0 = pair.pair.adhesion / pair.cohesive_stress;
  const double c = R * (s + std::sqrt(std::max(0.0, s * s + 2.0 * (h0 + overlap) / R)));
  return {0.0, c, overlap, -kPi * c * c * pair.cohesive_stress};
}

}  // namespace

MaugisCurve make_maugis_curve(const MaugisPair& pair) {
  const SpherePair& p = pair.pair;
  MaugisCurve out{pair};
  if (p.adhesion == 0.0) return out;
  ACINUS_ASSERT(pair.cohesive_stress > 0.0);
  out.lambda = maugis_lambda(pair);
  // At A = 0 the slope vanishes by symmetry; its sign nearby gives the direction of the curve. JKR
  // (large lambda) turns at A = 6^(-1/3) = 0.55, all others nearer 0.
  constexpr double kNearZero = 1e-4, kBeyondFold = 1.0;
  const auto slope = [&](double a) { return maugis_approach_slope(out.lambda, a); };
  const bool turns = slope(kNearZero) < 0.0;
  if (turns) out.least_radius = maugis_radius_unit(p) * find_root(slope, kNearZero, kBeyondFold);
  const MaugisPoint end = maugis_at_radius(pair, out.least_radius);
  const double s = rim_rise(pair);
  out.contact_overlap = end.overlap;
  out.least_overlap =
      turns ? end.overlap
            : std::min(end.overlap, -p.adhesion / pair.cohesive_stress - 0.5 * p.radius * s * s);
  return out;
}

MaugisPoint maugis_at_overlap(const MaugisCurve& curve, double overlap) {
  const SpherePair& p = curve.pair.pair;
  if (overlap < curve.least_overlap) return {0.0, 0.0, overlap, 0.0};
  if (p.adhesion == 0.0) {
    const SphereForce hertz = hertz_force(p, overlap);
    return {hertz.contact_radius, hertz.contact_radius, overlap, hertz.force};
  }
  if (overlap < curve.contact_overlap) return ring_at_overlap(curve.pair, overlap);
  const double unit = maugis_radius_unit(p), target = overlap * p.radius / (unit * unit);
  const auto excess = [&](double a) { return maugis_state(curve.lambda, a).approach - target; };
  const double low = curve.least_radius / unit;
  double high = std::max(1.0, 2.0 * low);
  while (excess(high) <= 0.0) high *= 2.0;
  return maugis_at_radius(curve.pair, unit * find_root(excess, low, high));
}

}  // namespace acinus::contact
