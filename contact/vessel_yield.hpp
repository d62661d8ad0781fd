#pragma once
/// Limit of the indentation of a vessel wall under cells of either model.

#include <cmath>

#include "contact/material.hpp"

namespace acinus::contact {

/// Largest indentation of a vessel wall over the radius of the vessel. Linear elasticity is limited
/// to small indentations; a wall without a limit would let a cell enclose a thin vessel
/// (decision 29).
inline constexpr double kMostIndentation = 0.15;

/// Largest indentation depth of a vessel wall, um; 0 if it is rigid. @param radius  um, of the
/// vessel
inline double yield_limit(const Material& wall, double radius) {
  return std::isfinite(wall.young) ? kMostIndentation * radius : 0;
}

}  // namespace acinus::contact
