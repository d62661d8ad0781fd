#pragma once
/// Shapes of cells at the start, where they come from images or meshes.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupling/world/world.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

/// The surface that a cell is to have.
struct CellSurface {
  std::int64_t lineage = 0;
  const geometry::Surface* surface = nullptr;  ///< closed, outward
};

struct TakenShapes {
  int laid = 0, inflated = 0;  ///< cells whose mesh was cast onto it, blown up inside it
  std::vector<std::pair<std::int64_t, std::string>> round;  ///< left balls: lineage, cause
  double worst_quality = 1;                                 ///< of a triangle
};

/// Gives deformable cells the shape of a surface: its volume is their reference volume, their
/// cortex takes the shape for rest and forgets that in kForgetShape (dcm/shape/lay_mesh.hpp). Cells
/// whose mesh does not fit stay balls of that volume. Spheres stay what they are. Ascending by
/// lineage; the same for any number of threads.
/// @pre t = 0; radius and centre of each cell are those of its surface
TakenShapes take_shapes(const std::vector<CellSurface>& surfaces, World& world);

}  // namespace acinus::coupling
