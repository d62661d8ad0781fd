#pragma once
/// An optical stretcher: two laser beams that pull at deformable cells while they shine.

#include <vector>

#include "core/vec.hpp"
#include "dcm/optical_stress.hpp"
#include "dcm/terms/stretch_load.hpp"

namespace acinus::coupling {

struct Pulse {
  double from = 0, to = 2;  ///< s since t = 0
};

struct Stretcher {
  dcm::LaserBeams beams;
  Vec3 axis = Vec3::UnitX();  ///< of the beams, any length > 0
  double exponent = 2;        ///< how the stress falls with the angle to the axis
  std::vector<Pulse> pulse;   ///< when the beams shine
};

/// The load on every cell; without stress while the beams are off.
dcm::StretchLoad stretch_at(const Stretcher& stretcher, double time);

/// The next moment after `time` at which a pulse begins or ends, s; infinite if none does.
double next_switch(const Stretcher& stretcher, double time);

}  // namespace acinus::coupling
