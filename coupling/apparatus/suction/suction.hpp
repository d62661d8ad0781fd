#pragma once
/// Suction in a pipette over time. The tube itself is a wall: contact::Pipette.

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "coupling/apparatus/device.hpp"
#include "coupling/apparatus/suction/suction_load.hpp"

namespace acinus::coupling {

struct Suction final : Device {
  Vec3 mouth = Vec3::Zero();  ///< as SuctionLoad
  Vec3 axis = Vec3::UnitZ();
  double reach = 0;
  Schedule pressure;  ///< kPa, pressure difference to the outside over s since t = 0; empty: none

  /// Load on every cell; zero pressure without suction.
  SuctionLoad load_at(double time) const;

  double next_change(double time) const override;
  void add_loads(double time, const LoadedCells& cells,
                 std::span<solve::RankOne> own) const override;
};

}  // namespace acinus::coupling
