#pragma once
/// Initial positions and strength of the two daughters of a dividing sphere.

#include <array>

#include "core/numbers/ramp.hpp"
#include "core/vec.hpp"

namespace acinus::cbm {

/// Sphere about to divide.
struct Mother {
  Vec3 center = Vec3::Zero();
  double radius = 0;                   ///< um, of its intrinsic volume
  Vec3 direction = Vec3::UnitX();      ///< unit, from the second daughter to the first
  double separation = 1;               ///< 0..1, share of the largest distance within the mother
  double time = 0, ramp_duration = 0;  ///< s
};

struct DaughterSpheres {
  std::array<Vec3, 2> center;
  double radius = 0;  ///< um, of each
  Ramp strength;      ///< of each
};

/// Two spheres of half the volume each, R_d = R_m / 2^(1/3), side by side within the mother and
/// with its centre of mass. At separation 1 both touch the mother's sphere from inside, 2 (R_m -
/// R_d) = 0.52 R_d apart: nowhere do they reach further than the mother did, but they overlap by
/// 1.48 R_d, where the law of contact would tear them apart. Hence their strength rises from 0 to 1
/// over the ramp.
/// @pre radius > 0, direction of length one, separation 0..1, ramp_duration >= 0 (asserted)
DaughterSpheres divide(const Mother& mother);

}  // namespace acinus::cbm
