#pragma once
/// Initial shapes of cells from images or meshes.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupling/world/world.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

/// Target surface of a cell.
struct CellSurface {
  std::int64_t lineage = 0;
  const geometry::Surface* surface = nullptr;  ///< closed, outward
};

struct TakenShapes {
  int laid = 0, inflated = 0;  ///< cells by kind of fit: projected onto it, inflated inside it
  std::vector<std::pair<std::int64_t, std::string>> round;  ///< cells left as balls: lineage, cause
  double worst_quality = 1;                                 ///< of all triangles
};

/// Shapes deformable cells to surfaces. The enclosed volume becomes the reference volume. The
/// cortex takes the shape as its rest shape and relaxes from it within kForgetShape
/// (dcm/shape/lay_mesh.hpp). Cells whose mesh does not fit remain balls of that volume. Spheres do
/// not change. Cells are processed in ascending order of lineage; the result does not depend on the
/// number of threads.
/// @pre t = 0; radius and centre of each cell are those of its surface
TakenShapes take_shapes(const std::vector<CellSurface>& surfaces, World& world);

}  // namespace acinus::coupling
