#pragma once
/// How crowded the neighbourhood of each cell is.

#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Radius of the ball in which neighbours are counted, um: two cell diameters at rest.
inline constexpr double kDensityReach = 48;

/// Number of cell centres within kDensityReach of each cell's centre, its own counted, per volume
/// of that ball, 1/um^3; [dcm lanes, then cbm cells], 0 where there is no cell. Cells behind a
/// mirror plane count as their images do. Vessels are not taken off the volume.
std::vector<double> local_densities(const World& world);

/// Volume at rest of the cells counted by local_densities over that of the ball, dimensionless.
std::vector<double> local_volume_shares(const World& world);

}  // namespace acinus::coupling
