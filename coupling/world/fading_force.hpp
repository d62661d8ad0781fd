#pragma once
/// Pair forces that fade: the difference in force between a contact before and after one of its
/// cells changed its model.

#include <cstdint>

#include "core/numbers/ramp.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

inline constexpr std::int64_t kNoPartner = -1;

struct FadingForce {
  std::int64_t a = 0, b = kNoPartner;  ///< lineages; b: none if the partner is boundary
  Vec3 force = Vec3::Zero();           ///< nN, on a while the share is 1; b gets the opposite
  double virial = 0;                   ///< nN um, force . arm of a, what it adds to its stress
  Ramp share;                          ///< from 1 to 0
  Vec3 apart = Vec3::Zero();  ///< um, centre of a from that of b, or from the origin, at first
  double reach = 0;           ///< um, how far they may move from that before none is left
};

}  // namespace acinus::coupling
