#include "contact/jkr.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

namespace {

double fold_radius(const SpherePair& p) {
  return std::cbrt(kPi * p.adhesion * p.radius * p.radius / (8.0 * p.modulus));
}

// Root e = y - 1 >= 0 of 6 e^2 + 4 e^3 + e^4 = t, which is y^4 - 4 y + 3 = t without cancellation
// at y = 1.
double solve_above_fold(double t) {
  if (t == 0.0) return 0.0;
  // (e^2 + 2 e)^2 <= t and 6 e^2 <= t: two upper bounds, the first exact for large t, the second
  // for small.
  const double root = std::sqrt(t);
  constexpr double kInverseSqrt6 = 0.40824829046386302;
  double e = std::min(root / (1.0 + std::sqrt(1.0 + root)), kInverseSqrt6 * root);
  // After a step of relative size s the error left is at most 1.5 s^2.
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double value = e * e * (6.0 + e * (4.0 + e)) - t;
    const double slope = e * (12.0 + e * (12.0 + 4.0 * e));
    const double step = value / slope;
    e -= step;
    if (!(std::abs(step) > 1e-8 * e)) break;
  }
  return e;
}

}  // namespace

SphereForce jkr_force(const SpherePair& pair, double overlap, bool was_touching) {
  ACINUS_ASSERT(pair.radius > 0.0 && std::isfinite(pair.radius));
  ACINUS_ASSERT(pair.modulus > 0.0 && std::isfinite(pair.modulus));
  ACINUS_ASSERT(pair.adhesion >= 0.0);
  if (overlap < 0.0 && !was_touching) return {};
  const double fold = fold_radius(pair);
  const double scale = fold * fold / pair.radius;  // overlap = scale (y^4 - 4 y)
  if (overlap < -3.0 * scale) return {};
  // Beyond this ratio adhesion changes the force by less than 1e-17 of itself; W = 0 belongs here
  // too.
  constexpr double kHertzRatio = 1e24;
  if (scale == 0.0 || overlap > kHertzRatio * scale) return hertz_force(pair, overlap);

  double t = overlap / scale + 3.0;
  if (t < 0.0) t = 0.0;  // round-off at the fold; written so that NaN stays NaN
  const double e = solve_above_fold(t);
  const double y = 1.0 + e;
  const double y3 = y * y * y;
  const double unit = 4.0 * pair.modulus * fold * scale / 3.0;  // force = unit (y^6 - 6 y^3)
  constexpr double kChord =
      -3.423740563105362;  // (F_pulloff - F_fold)/(delta_pulloff - delta_fold) in E a_d
  SphereForce out;
  out.touching = true;
  out.contact_radius = fold * y * y;
  out.force = unit * y3 * (y3 - 6.0);
  const double rise = e * (3.0 + e * (3.0 + e));  // y^3 - 1
  const double slope = 2.0 * y * y * (y3 - 3.0) / rise;
  const double stiffness = e > 0.0 ? std::max(slope, kChord) : kChord;  // in E a_d
  out.stiffness = stiffness * pair.modulus * fold;
  out.force_by_modulus = (unit * y3 * (y3 - 3.0) - out.stiffness * 2.0 * scale * y) / pair.modulus;
  return out;
}

JkrPoint jkr_at_radius(const SpherePair& pair, double contact_radius) {
  const double a = contact_radius;
  const double pull = std::sqrt(2.0 * kPi * pair.adhesion * a / pair.modulus);
  return {a, a * a / pair.radius - pull,
          4.0 * pair.modulus * a * a * a / (3.0 * pair.radius) - 2.0 * pair.modulus * a * pull};
}

double jkr_overlap(const SpherePair& pair, double force) {
  // Eq. (20) is a quadratic in a^(3/2).
  const double c = 4 * pair.modulus / (3 * pair.radius);
  const double b = std::sqrt(8 * kPi * pair.adhesion * pair.modulus);
  const double root = std::sqrt(std::max(0.0, b * b + 4 * c * force));
  return jkr_at_radius(pair, std::pow((b + root) / (2 * c), 2.0 / 3)).overlap;
}

double jkr_energy(const SpherePair& pair, double contact_radius) {
  const double a = contact_radius;
  const double hertz = pair.modulus * a * a * a * a * a / (pair.radius * pair.radius);
  const double mixed =
      std::sqrt(2.0 * kPi * pair.adhesion * pair.modulus * a) * a * a * a / pair.radius;
  return (8.0 / 15.0) * hertz - (4.0 / 3.0) * mixed + kPi * pair.adhesion * a * a;
}

JkrSpecial jkr_special(const SpherePair& pair) {
  const double fold = fold_radius(pair);
  const double unit = kPi * pair.adhesion * pair.radius;
  // y^3 = 1, 3, 4 and 6: fold, least force, zero overlap, zero force.
  const auto at = [&](double y3) { return jkr_at_radius(pair, fold * std::cbrt(y3 * y3)); };
  return {at(1.0), at(3.0), at(4.0), at(6.0), -2.0 * unit, -unit};
}

}  // namespace acinus::contact
