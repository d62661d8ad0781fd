#pragma once
/// Values and gradients of a field between the centres of voxels.

#include <span>

#include "substances/grid.hpp"

namespace acinus::substances {

/// Trilinear interpolation; constant beyond the outermost centres.   @param field  [n_voxel]
double interpolate(const VoxelGrid& grid, std::span<const double> field, const Vec3& point);

/// Gradient, 1/um of the field: differences of interpolated values half a voxel to either side.
/// Second order inside; half a voxel from a face of the box it is that of the nearest pair of
/// voxels.
Vec3 gradient_at(const VoxelGrid& grid, std::span<const double> field, const Vec3& point);

}  // namespace acinus::substances
