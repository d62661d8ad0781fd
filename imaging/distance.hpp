#pragma once
/// Distances from the wall of a set of voxels.

#include <cstdint>
#include <vector>

#include "imaging/label_image.hpp"

namespace acinus::imaging {

/// Numbers at the centres of voxels.
struct Grid {
  Voxel size{};
  Vec3 voxel = Vec3::Zero();   ///< um
  Vec3 origin = Vec3::Zero();  ///< um, centre of voxel (0, 0, 0)
  std::vector<double> value;   ///< [z][y][x]

  std::size_t index(const Voxel& v) const {
    return (static_cast<std::size_t>(v[2]) * size[1] + v[1]) * size[0] + v[0];
  }
  /// Linear along each axis between centres; beyond the outermost as there.
  double at(const Vec3& x) const;
};

/// um from the nearest voxel of the other kind, negative inside, at every centre: the wall lies in
/// the middle between two of different kind. Exact, by one pass an axis [Felzenszwalb2012].
/// @param inside  [z][y][x], with at least one voxel of each kind
void find_signed_distance(const std::vector<std::uint8_t>& inside, Grid& grid);

/// Mean over a Gaussian of so many voxels (standard deviation) along each axis.
void smooth(const Vec3& voxels, Grid& grid);

/// um per um, an upper bound of the slope of Grid::at.
double find_steepest(const Grid& grid);

}  // namespace acinus::imaging
