#pragma once
/// JKR contact law of eight pairs at once: jkr_force in lanes, without branches.

#include "core/numbers/lanes.hpp"

namespace acinus::contact {

/// Result for eight pairs; all zero without contact.
struct JkrLanes {
  Lane force;           ///< nN, positive = repulsive
  Lane stiffness;       ///< nN/um, as SphereForce::stiffness
  Lane squared_radius;  ///< um^2, of the contact
  Lane touching;        ///< 1 or 0
};

/// Cube root of positive numbers: a guess from the exponent, then three steps of third order.
ACINUS_INLINE Lane lane_cbrt(Lane v) {
  using Bits = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));
  Bits bits;
  __builtin_memcpy(&bits, &v, sizeof(bits));
  Bits third;
  for (int l = 0; l < kLanes; ++l) third[l] = bits[l] / 3 + 0x2a9f789300000000;
  Lane x;
  __builtin_memcpy(&x, &third, sizeof(x));
  for (int step = 0; step < 3; ++step) {
    const Lane cube = x * x * x;
    x *= (cube + 2.0 * v) / (2.0 * cube + v);
  }
  return x;
}

/// Force of eight pairs on the branch that is stable at fixed overlap. Reference: the scalar
/// jkr_force (equal to 1e-12 of the larger of the force's two terms away from the fold). Newton
/// from above the root of a convex function with a fixed number of steps. Adhesion 0 is Hertz.
/// @param radius, modulus  R^ (um) and E^ (kPa), positive
/// @param adhesion         W, nN/um, not negative
/// @param overlap          um
/// @param was_touching     1 or 0
ACINUS_INLINE JkrLanes jkr_force_lanes(Lane radius, Lane modulus, Lane adhesion, Lane overlap,
                                       Lane was_touching) {
  const Lane zero = lane_of(0), one = lane_of(1);
  const Lane fold = lane_cbrt(kPi * adhesion * radius * radius / (8.0 * modulus) + 1e-300);
  const Lane scale = fold * fold / radius;  // overlap = scale (y^4 - 4 y)
  const Lane distance = overlap / scale + 3.0;
  const Lane t = distance < 0.0 ? zero : distance;  // written so that NaN stays NaN
  const Lane root = lane_sqrt(t);
  const Lane far = root / (1.0 + lane_sqrt(1.0 + root)), near = 0.40824829046386302 * root;
  Lane e = (far < near ? far : near) + 1e-30;
  for (int step = 0; step < 5; ++step) {
    const Lane value = e * e * (6.0 + e * (4.0 + e)) - t;
    e -= value / (e * (12.0 + e * (12.0 + 4.0 * e)));
  }
  const Lane y = one + e, y2 = y * y, y3 = y2 * y;
  constexpr double kChord = -3.423740563105362;  // as in jkr_force
  const Lane slope = 2.0 * y2 * (y3 - 3.0) / (e * (3.0 + e * (3.0 + e)));
  const Lane chord = lane_of(kChord);
  JkrLanes out;
  out.force = (4.0 / 3.0) * modulus * fold * scale * y3 * (y3 - 6.0);
  out.stiffness = (slope > chord ? slope : chord) * modulus * fold;
  out.squared_radius = fold * fold * y2 * y2;
  out.touching = overlap < 0.0 ? (distance < 0.0 ? zero : was_touching) : one;

  // Beyond this ratio of overlap to scale adhesion no longer shows; W = 0 belongs here too.
  const Lane pressed = overlap < 0.0 ? zero : overlap;
  const Lane hertz_squared = radius * pressed, hertz_radius = lane_sqrt(hertz_squared);
  const auto hertz = pressed > 1e24 * scale;
  out.force = hertz ? (4.0 / 3.0) * modulus * hertz_radius * pressed : out.force;
  out.stiffness = hertz ? 2.0 * modulus * hertz_radius : out.stiffness;
  out.squared_radius = hertz ? hertz_squared : out.squared_radius;

  out.force *= out.touching;
  out.stiffness *= out.touching;
  out.squared_radius *= out.touching;
  return out;
}

}  // namespace acinus::contact
