#include "contact/maugis.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

namespace {

// H > 0 where the closure is 1. It grows from 0 with H, so a bracket always exists.
double solve_closure(double lambda, double a) {
  double low = 0.0, high = 1.0;
  while (evaluate_closure(lambda, a, high).value < 1.0) {
    low = high;
    high *= 2.0;
  }
  double h = high;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const MaugisClosure f = evaluate_closure(lambda, a, h);
    (f.value < 1.0 ? low : high) = h;
    const double previous = h;
    h -= (f.value - 1.0) / f.by_h;
    if (!(h > low && h < high)) h = 0.5 * (low + high);
    if (std::abs(h - previous) <= 1e-15 * h) break;
  }
  return h;
}

// d load/dA along the curve, where H follows A through the closure.
double load_slope(double lambda, double a) {
  const double h = solve_closure(lambda, a);
  const MaugisClosure f = evaluate_closure(lambda, a, h);
  const double theta = std::atan2(h, a);
  const double by_a = 3.0 * a * a - 2.0 * lambda * a * theta;
  const double by_h = -2.0 * lambda * (a + h * theta);
  return by_a - by_h * f.by_a / f.by_h;
}

/// A at the end of the contact branch.
/// @pre maugis_turns(lambda)
double turning_point(double lambda) {
  // JKR (large lambda) turns at A = 6^(-1/3) = 0.55, all others nearer 0.
  double low = 0.0, high = 1.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double middle = 0.5 * (low + high);
    (maugis_approach_slope(lambda, middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

MaugisClosure evaluate_closure(double lambda, double a, double h) {
  const double theta = std::atan2(h, a);  // asec m
  const double c2 = a * a + h * h;
  const double c = std::sqrt(c2);
  const double ring = (4.0 / 3.0) * lambda * lambda;
  MaugisClosure out;
  out.value =
      0.5 * lambda * ((h * h - a * a) * theta + a * h) + ring * (h * theta - h * h / (c + a));
  out.by_h = lambda * (h * theta + h * h * a / c2) + ring * (theta + h * a / c2 - h / c);
  out.by_a = lambda * (a * a * h / c2 - a * theta) + ring * (a * a / c2 - a / c);
  return out;
}

double maugis_radius_unit(const SpherePair& p) {
  return std::cbrt(3.0 * kPi * p.adhesion * p.radius * p.radius / (4.0 * p.modulus));
}

double maugis_lambda(const MaugisPair& pair) {
  const SpherePair& p = pair.pair;
  ACINUS_ASSERT(p.adhesion > 0.0 && p.modulus > 0.0 && p.radius > 0.0);
  return pair.cohesive_stress *
         std::cbrt(9.0 * p.radius / (2.0 * kPi * p.adhesion * p.modulus * p.modulus));
}

MaugisState maugis_state(double lambda, double a) {
  ACINUS_ASSERT(lambda > 0.0 && a >= 0.0);
  return maugis_state(lambda, a, solve_closure(lambda, a));
}

MaugisState maugis_state(double lambda, double a, double h) {
  const double c2 = a * a + h * h;
  const double load = a * a * a - lambda * (a * h + c2 * std::atan2(h, a));
  return {a, std::sqrt(c2), load, a * a - (4.0 / 3.0) * lambda * h};
}

double maugis_approach_slope(double lambda, double a) {
  const MaugisClosure f = evaluate_closure(lambda, a, solve_closure(lambda, a));
  return 2.0 * a + (4.0 / 3.0) * lambda * f.by_a / f.by_h;
}

bool maugis_turns(double lambda) {
  // At A = 0 the slope vanishes by symmetry; its sign nearby is the direction of the curve.
  constexpr double kNearZero = 1e-4;
  return maugis_approach_slope(lambda, kNearZero) < 0.0;
}

MaugisState maugis_pull_off(double lambda) {
  ACINUS_ASSERT(lambda > 0.0);
  // The load falls from A = 0 (slope proportional to -A) and rises beyond JKR's A = (3/2)^(1/3)
  // = 1.145.
  double low = 0.0, high = 1.2;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double middle = 0.5 * (low + high);
    (load_slope(lambda, middle) < 0.0 ? low : high) = middle;
  }
  return maugis_state(lambda, 0.5 * (low + high));
}

MaugisPoint maugis_at_radius(const MaugisPair& pair, double contact_radius) {
  const SpherePair& p = pair.pair;
  const double unit = maugis_radius_unit(p);
  const MaugisState state = maugis_state(maugis_lambda(pair), contact_radius / unit);
  return {contact_radius, state.c * unit, state.approach * unit * unit / p.radius,
          state.load * kPi * p.adhesion * p.radius};
}

double maugis_turning_radius(const MaugisPair& pair) {
  const double lambda = maugis_lambda(pair);
  return maugis_turns(lambda) ? maugis_radius_unit(pair.pair) * turning_point(lambda) : 0.0;
}

double maugis_adhesive_pressure(double cohesive_stress, double a, double c, double r) {
  if (r > c) return 0.0;
  if (r >= a) return -cohesive_stress;
  const double cosine = (2.0 * a * a - c * c - r * r) / (c * c - r * r);
  return -cohesive_stress / kPi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

double hertz_pressure(const SpherePair& pair, double a, double r) {
  if (r >= a) return 0.0;
  return 2.0 * pair.modulus / (kPi * pair.radius) * std::sqrt((a - r) * (a + r));
}

}  // namespace acinus::contact
