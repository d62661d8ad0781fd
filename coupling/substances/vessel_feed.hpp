#pragma once
/// Vessels as sources of a substance along their length.

#include <span>

#include "geometry/network.hpp"
#include "substances/grid.hpp"

namespace acinus::coupling {

/// Adds permeability (concentration - c) per area of the vessel walls to the sources of a medium,
/// gain - loss c per volume of a voxel.
/// The area of a wall counts in the voxels it passes through; parts outside the box count nothing.
/// @param permeability  um/s
/// @param gain, loss     [n_voxel], added to
void add_vessel_feed(const substances::VoxelGrid& grid, const geometry::Network& vessels,
                     double permeability, double concentration, std::span<double> gain,
                     std::span<double> loss);

}  // namespace acinus::coupling
