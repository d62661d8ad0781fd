#pragma once
/// Stress of two laser beams facing each other on a cell between them.

#include <cmath>

#include "core/vec.hpp"

namespace acinus::coupling {

inline constexpr double kLightSpeed = 2.99792458e14;  ///< um/s

/// Two equal beams along one axis.
struct LaserBeams {
  double power = 0;      ///< nN um/s (1e15 are a watt), of one beam
  double radius = 8.2;   ///< um
  double medium = 1.33;  ///< refractive index of the liquid
  double cell = 1.36;    ///< refractive index of the cell
};

/// Fraction of light reflected by the surface of the cell at normal incidence. [VanLiedekerke2020,
/// Eq. (29)]
inline double reflectance(const LaserBeams& b) {
  const double r = (b.cell - b.medium) / (b.cell + b.medium);
  return r * r;
}

/// Stress on the surface at the axis, kPa, outward positive: momentum gained by the light of both
/// beams over their cross-section. [VanLiedekerke2020, Eq. (28) and (31), positive where those are
/// negative]
inline double stress_amplitude(const LaserBeams& b) {
  const double r = reflectance(b);
  const double enters = b.medium - (1 - r) * b.cell + r * b.medium;
  const double leaves = (b.cell - (1 - r) * b.medium + r * b.cell) * (1 - r);
  return (leaves - enters) * b.power / kLightSpeed / (kPi * b.radius * b.radius);
}

}  // namespace acinus::coupling
