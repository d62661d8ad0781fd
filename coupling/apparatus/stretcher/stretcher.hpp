#pragma once
/// Optical stretcher: two laser beams that stretch deformable cells in pulses.

#include <vector>

#include "core/vec.hpp"
#include "coupling/apparatus/device.hpp"
#include "coupling/apparatus/stretcher/optical_stress.hpp"
#include "coupling/apparatus/stretcher/stretch_load.hpp"

namespace acinus::coupling {

struct Pulse {
  double from = 0, to = 2;  ///< s since t = 0
};

struct Stretcher final : Device {
  LaserBeams beams;
  Vec3 axis = Vec3::UnitX();  ///< axis of the beams, any length > 0
  double exponent = 2;        ///< exponent of the cosine of the angle to the axis
  std::vector<Pulse> pulse;   ///< intervals with beams on

  /// Load on every cell; zero stress with beams off.
  StretchLoad load_at(double time) const;

  double next_change(double time) const override;
  void add_loads(double time, const LoadedCells& cells,
                 std::span<solve::RankOne> own) const override;
};

}  // namespace acinus::coupling
