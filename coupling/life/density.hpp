#pragma once
/// Local density of cells.

#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Radius of the ball of the density count, um: two cell diameters at rest.
inline constexpr double kDensityReach = 48;

/// Number density of cells around each cell, 1/um^3: centres within kDensityReach, its own
/// included, per volume of that ball; [dcm lanes, then cbm cells], 0 in empty lanes. Mirror images
/// of cells count. The volume of vessels is not subtracted.
std::vector<double> local_densities(const World& world);

/// Volume fraction around each cell: rest volume of the cells counted by local_densities over that
/// of the ball.
std::vector<double> local_volume_shares(const World& world);

}  // namespace acinus::coupling
