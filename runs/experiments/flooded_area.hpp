#pragma once
/// Open area of the lesion by flooding: the uncovered space that is connected to the central vein.
///
/// A lattice of cubes with an edge of one cell radius (half a diameter) covers the initial lesion.
/// A cube is open if cells cover less than half of its points outside vessels; the flood starts at
/// the open cubes beside the vein and passes through faces. Gaps between cells that are narrower
/// than a cube are not counted, as in areas measured in images of a lesion [Hoehme2010].

#include <cstdint>
#include <vector>

#include "runs/experiments/open_area.hpp"

namespace acinus::runs {

/// Cubes of the flood and their sample points.
struct FloodLattice {
  int points = 3;                  ///< along the edge of a cube
  double spacing = 4;              ///< um, between points of a slice
  int n[3] = {0, 0, 0};            ///< cubes along x, y, z
  double low[2] = {0, 0};          ///< um, corner of the lattice in x and y
  std::vector<int> layer;          ///< [slice] index of the cube along z
  std::vector<std::uint8_t> free;  ///< [slice][y][x] of points; 1: in the lesion, not in a vessel
  std::vector<std::uint8_t> seed;  ///< [cube] 1: beside the vein
};

/// Lattice of a lobule before the first frame is measured.
/// @param grid  slices and extent of the lesion
FloodLattice make_flood_lattice(const LesionGrid& grid, const LobuleDomain& lobule,
                                const geometry::Network& vessels);

/// Area of the flooded cubes outside vessels, mean over height, um^2.
/// @param sections  at the heights of the lesion grid
double measure_flooded_area(const FloodLattice& lattice, const std::vector<Section>& sections);

}  // namespace acinus::runs
