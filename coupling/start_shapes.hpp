#pragma once
/// Shapes of cells at the start, where they were placed in each other.

#include <cstdint>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct CutCells {
  std::vector<std::int64_t> cells;  ///< lineages, ascending
  double smallest_volume = 1;       ///< of one of them over its reference volume
};

/// Gives the shape of the room they have to deformable cells that overlap others by more than
/// contact looks for (ContactParams::max_depth): from there on contact does not find the way out,
/// or tears meshes on it. Each is its ball up to the planes in which it meets the balls of all
/// others, so that two cut cells touch in a plane without overlap, under the pressure of the volume
/// that both lack. Spheres stay what they are. The cortex takes the shape for rest and forgets that
/// in kForgetShape, as after a division (dcm/birth_shape.hpp). @pre t = 0, every cell a ball
CutCells cut_overlapping(World& world);

}  // namespace acinus::coupling
