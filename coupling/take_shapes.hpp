#pragma once
/// Shapes of cells at the start, where they come from images or meshes.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/surface.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The surface that a cell is to have.
struct CellSurface {
  std::int64_t lineage = 0;
  const mesh::Surface* surface = nullptr;  ///< closed, outward
};

struct TakenShapes {
  int laid = 0, filled = 0;  ///< cells whose mesh was laid over the surface, blown up inside it
  std::vector<std::pair<std::int64_t, std::string>> round;  ///< left balls: lineage, cause
  double worst_quality = 1;                                 ///< of a triangle
};

/// Gives deformable cells the shape of a surface: its volume is their reference volume, their
/// cortex takes the shape for rest and forgets that in kForgetShape. Where no point sees the whole
/// surface, a ball is blown up inside it. Cells whose mesh fits neither way stay balls of that
/// volume. Spheres stay what they are. Ascending by lineage; the same for any number of threads.
/// @pre t = 0; radius and centre of each cell are those of its surface
TakenShapes take_shapes(const std::vector<CellSurface>& surfaces, World& world);

}  // namespace acinus::coupling
