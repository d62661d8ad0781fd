#pragma once
/// Vessels as sources of a substance along their length.

#include "geometry/network.hpp"
#include "substances/grid.hpp"
#include "substances/medium.hpp"

namespace acinus::coupling {

/// Adds permeability (concentration - c) per area of the vessel walls to the sources of a medium.
/// The area of a wall counts in the voxels it passes through; parts outside the box count nothing.
/// @param permeability  um/s
/// @pre medium.gain and loss have a number per voxel
void add_vessel_feed(const substances::VoxelGrid& grid, const geometry::Network& vessels,
                     double permeability, double concentration, substances::Medium& medium);

}  // namespace acinus::coupling
