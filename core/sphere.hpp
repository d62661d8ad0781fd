#pragma once
/// Volume and radius of a sphere.

#include <cmath>

#include "core/vec.hpp"

namespace acinus {

inline double sphere_volume(double radius) { return 4.0 / 3 * kPi * std::pow(radius, 3); }
inline double sphere_radius(double volume) { return std::cbrt(volume / (4.0 / 3 * kPi)); }

}  // namespace acinus
