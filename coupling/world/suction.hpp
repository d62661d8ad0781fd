#pragma once
/// Suction in a pipette over time.

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "dcm/terms/suction_load.hpp"

namespace acinus::coupling {

struct Suction {
  Vec3 mouth = Vec3::Zero();  ///< as dcm::SuctionLoad
  Vec3 axis = Vec3::UnitZ();
  double reach = 0;
  Schedule pressure;  ///< kPa below that outside, over s since t = 0; empty: none
};

/// The load on every cell; without pressure if there is no suction.
inline dcm::SuctionLoad suction_at(const Suction& s, double time) {
  return {s.mouth, s.axis, s.reach, s.pressure.entry.empty() ? 0 : s.pressure.at(time)};
}

}  // namespace acinus::coupling
