#pragma once
/// Label image: each voxel has the number of the cell that it is part of.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace acinus::imaging {

using Label = std::uint32_t;
using Voxel = std::array<int, 3>;  ///< x, y, z from 0

/// Voxels of an image. Voxel (i, j, k) is the box from (i, j, k) to (i + 1, j + 1, k + 1), times
/// `voxel`.
struct VoxelLattice {
  Voxel size{};               ///< voxels along x, y, z
  Vec3 voxel = Vec3::Zero();  ///< um, sides of a voxel

  std::size_t index(const Voxel& v) const {
    return (static_cast<std::size_t>(v[2]) * size[1] + v[1]) * size[0] + v[0];
  }
  std::size_t n_voxel() const { return index({0, 0, size[2]}); }
  Vec3 center(const Voxel& v) const {
    return voxel.cwiseProduct(Vec3(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5));
  }
  double voxel_volume() const { return voxel.prod(); }                                 ///< um^3
  Vec3 extent() const { return voxel.cwiseProduct(Vec3(size[0], size[1], size[2])); }  ///< um
};

/// Label image with a number per voxel, as `voxelise` makes it.
struct LabelImage : VoxelLattice {
  std::vector<Label> label;  ///< [z][y][x]; 0 is the background
};

}  // namespace acinus::imaging
