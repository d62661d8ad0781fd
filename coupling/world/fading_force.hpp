#pragma once
/// Fading pair force: difference of the contact force before and after a change of model of one
/// cell.

#include <cstdint>

#include "core/numbers/ramp.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

inline constexpr std::int64_t kNoPartner = -1;

struct FadingForce {
  std::int64_t a = 0, b = kNoPartner;  ///< lineages; b: kNoPartner for boundary
  Vec3 force = Vec3::Zero();           ///< nN, on a at share 1; the opposite on b
  double virial = 0;                   ///< nN um, force . arm of a, its part of the stress
  Ramp share;                          ///< from 1 to 0
  Vec3 apart = Vec3::Zero();  ///< um, initial centre of a relative to that of b, or to the origin
  double reach = 0;           ///< um, relative displacement that ends the force
};

}  // namespace acinus::coupling
