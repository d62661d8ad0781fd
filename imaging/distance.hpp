#pragma once
/// Signed distance from the wall of a set of voxels.

#include <cstdint>
#include <vector>

#include "imaging/label_image.hpp"

namespace acinus::imaging {

/// Scalar field, sampled at the centres of voxels.
struct Grid {
  Voxel size{};
  Vec3 voxel = Vec3::Zero();   ///< um
  Vec3 origin = Vec3::Zero();  ///< um, centre of voxel (0, 0, 0)
  std::vector<double> value;   ///< [z][y][x]

  std::size_t index(const Voxel& v) const {
    return (static_cast<std::size_t>(v[2]) * size[1] + v[1]) * size[0] + v[0];
  }
  std::size_t n_voxel() const { return index({0, 0, size[2]}); }
  /// Value at a point, linear along each axis between centres; beyond the outermost centres
  /// constant.
  double at(const Vec3& x) const;
};

/// Computes the signed distance of every centre from the nearest voxel of the other kind, um,
/// negative inside: the wall lies in the middle between two voxels of different kind. Exact, by one
/// pass per axis [Felzenszwalb2012].
/// @param inside  [z][y][x], with at least one voxel of each kind
void compute_signed_distance(const std::vector<std::uint8_t>& inside, Grid& grid);

/// Smooths a grid by a Gaussian. @param voxels  standard deviation along each axis, in voxels
void smooth(const Vec3& voxels, Grid& grid);

/// Upper bound of the slope of Grid::at, um per um.
double compute_largest_slope(const Grid& grid);

}  // namespace acinus::imaging
