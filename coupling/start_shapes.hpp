#pragma once
/// Initial shapes of deformable cells that were placed with overlap.

#include <cstdint>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct CutCells {
  std::vector<std::int64_t> cells;  ///< lineages, ascending
  double smallest_volume = 1;       ///< over the reference volume
};

/// Shapes deformable cells whose overlap exceeds the search depth of contact
/// (ContactParams::max_depth) so that they do not overlap. Beyond that depth contact finds no way
/// out or tears meshes. A cell becomes its ball cut at the power planes with the balls of its
/// neighbours. Two cut cells touch in a plane, under the pressure of the volume that both lack.
/// Spheres do not change. The cortex takes the shape as its rest shape and relaxes from it within
/// kForgetShape, as after a division (dcm/birth_shape.hpp).
/// @pre t = 0, every cell a ball
CutCells cut_overlapping(World& world);

}  // namespace acinus::coupling
