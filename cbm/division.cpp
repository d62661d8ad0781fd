#include "cbm/division.hpp"

#include <cmath>

#include "core/error.hpp"

namespace acinus::cbm {

DaughterSpheres divide(const Mother& m) {
  ACINUS_ASSERT(m.radius > 0);
  ACINUS_ASSERT(std::abs(m.direction.norm() - 1) < 1e-9);
  ACINUS_ASSERT(m.separation >= 0 && m.separation <= 1);
  ACINUS_ASSERT(m.ramp_duration >= 0);
  DaughterSpheres d;
  d.radius = m.radius / std::cbrt(2.0);
  const Vec3 arm = m.separation * (m.radius - d.radius) * m.direction;
  d.center = {m.center + arm, m.center - arm};
  d.strength = {0, 1, m.time, m.time + m.ramp_duration};
  return d;
}

}  // namespace acinus::cbm
