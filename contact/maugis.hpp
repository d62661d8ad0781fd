#pragma once
/// Adhesive elastic spheres with a cohesive ring of constant stress sigma0 between the radius a of
/// intimate contact and c [Maugis1992]: Eq. (14) to (17) of the model paper with their misprints
/// corrected. Covers JKR (large lambda) to DMT (small lambda). A reference law; steps use it where
/// the scene selects it. As a function of overlap: maugis_overlap.hpp; between triangles:
/// maugis_triangles.hpp.
///
/// Reduced quantities: A = a/a0, C = c/a0, a0 = (3 pi W R^2/(4 E))^(1/3), load = P/(pi W R),
/// approach = delta R/a0^2. Positive load = repulsive. R and E are the reduced values of the pair.

#include "contact/hertz.hpp"

namespace acinus::contact {

/// Pair with adhesion > 0 and a cohesive stress.
struct MaugisPair {
  SpherePair pair;
  double cohesive_stress;  ///< sigma0 in kPa; the range of adhesion is h0 = W/sigma0
};

/// Maugis parameter lambda = sigma0 (9 R/(2 pi W E^2))^(1/3), Eq. (15); 1.157 times Tabor's.
double maugis_lambda(const MaugisPair& pair);

/// Unit a0 of contact radii, um.
double maugis_radius_unit(const SpherePair& pair);

/// Point of the reduced curve.
struct MaugisState {
  double a;         ///< A
  double c;         ///< C = m A
  double load;      ///< P/(pi W R)
  double approach;  ///< delta R/a0^2
};

/// Solution of Eq. (16) for C, then load and approach:
///   lambda A^2/2 [(m^2 - 2) asec m + s] + 4 lambda^2 A/3 [s asec m - m + 1] = 1,
///   s = sqrt(m^2 - 1),  load = A^3 - lambda A^2 (s + m^2 asec m),
///   approach = A^2 - (4/3) lambda A s.
/// Solved for H = A s by bracketed Newton; A = 0 (cohesive ring alone) is regular in H.
/// @pre lambda > 0, a >= 0 (asserted)
MaugisState maugis_state(double lambda, double a);

/// Eq. (16) in A and H = sqrt(C^2 - A^2): regular at A = 0.
struct MaugisClosure {
  double value;  ///< 1 on the curve; grows with H
  double by_h, by_a;
};
MaugisClosure evaluate_closure(double lambda, double a, double h);

/// State at a known solution A, H of Eq. (16).
MaugisState maugis_state(double lambda, double a, double h);

/// Derivative d approach/dA along the curve, where H follows A through Eq. (16).
double maugis_approach_slope(double lambda, double a);

/// True if the contact branch ends at A > 0, where the approach is least: lambda above about 0.9.
/// Otherwise it goes on to A = 0 and to the cohesive ring alone.
bool maugis_turns(double lambda);

/// State of least load over all A (pull-off at fixed load): -2 for lambda -> 0 (DMT), -3/2 for
/// large lambda (JKR).
MaugisState maugis_pull_off(double lambda);

/// Point of the curve in um and nN.
struct MaugisPoint {
  double contact_radius;   ///< a
  double cohesive_radius;  ///< c
  double overlap;          ///< delta = a^2/R - (2 sigma0/E) sqrt(c^2 - a^2)
  double force;            ///< P, positive = repulsive
};
MaugisPoint maugis_at_radius(const MaugisPair& pair, double contact_radius);

/// Contact radius a at the end of the contact branch, um: 0 where it does not turn.
double maugis_turning_radius(const MaugisPair& pair);

/// Adhesive stress of the ring at radius r, kPa, negative = attractive, Eq. (14): -(sigma0/pi)
/// arccos((2 a^2 - c^2 - r^2)/(c^2 - r^2)) for r < a, -sigma0 for a <= r <= c, 0 beyond.
double maugis_adhesive_pressure(double cohesive_stress, double a, double c, double r);

/// Hertz pressure at radius r, Eq. (17): (2 E/(pi R)) sqrt(a^2 - r^2) inside a, 0 beyond, kPa.
double hertz_pressure(const SpherePair& pair, double a, double r);

}  // namespace acinus::contact
