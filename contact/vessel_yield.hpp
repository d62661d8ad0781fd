#pragma once
/// Depth to which a vessel wall yields under cells of either model.

#include <cmath>

#include "contact/material.hpp"

namespace acinus::contact {

/// Largest indentation of a vessel wall over the radius of the vessel. Linear elasticity is limited
/// to small indentations; a wall that went on yielding would let a cell close over a thin vessel
/// (docs/decisions/0029.md).
inline constexpr double kMostIndentation = 0.15;

/// Depth of that indentation, um; 0 for a rigid wall. @param radius  um, of the vessel
inline double yield_limit(const Material& wall, double radius) {
  return std::isfinite(wall.young) ? kMostIndentation * radius : 0;
}

}  // namespace acinus::contact
