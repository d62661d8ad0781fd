#pragma once
/// Regular grid of voxels in a box.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/vec.hpp"

namespace acinus::substances {

/// Voxels in storage order: x fastest, then y, then z.
struct VoxelGrid {
  Vec3 low = Vec3::Zero();      ///< um, corner with the smallest coordinates
  Vec3 spacing = Vec3::Ones();  ///< um, edges of a voxel
  std::array<int, 3> n{0, 0, 0};

  std::size_t n_voxel() const {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
           static_cast<std::size_t>(n[2]);
  }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n[0]) +
           static_cast<std::size_t>(i);
  }
  /// Numbers along the axes of the voxel at an index.
  std::array<int, 3> place(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(n[0]), ny = static_cast<std::size_t>(n[1]);
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / (nx * ny))};
  }
  /// Faces across an axis, in storage order: face i of a row is below its voxel i, and there is one
  /// more of them than voxels.
  std::size_t n_face(int axis) const {
    return n_voxel() / static_cast<std::size_t>(n[axis]) * static_cast<std::size_t>(n[axis] + 1);
  }
  std::size_t face_index(int axis, int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(n[0] + (axis == 0 ? 1 : 0)),
               ny = static_cast<std::size_t>(n[1] + (axis == 1 ? 1 : 0));
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
           static_cast<std::size_t>(i);
  }
  /// Number along an axis of the voxel at a coordinate; outside the box that of the nearest voxel.
  int voxel_at(int axis, double x) const {
    return static_cast<int>(
        std::clamp(std::floor((x - low[axis]) / spacing[axis]), 0.0, n[axis] - 1.0));
  }
  std::array<int, 3> voxel_at(const Vec3& x) const {
    return {voxel_at(0, x.x()), voxel_at(1, x.y()), voxel_at(2, x.z())};
  }
  std::size_t index_at(const Vec3& x) const {
    const auto [i, j, k] = voxel_at(x);
    return index(i, j, k);
  }
  double voxel_volume() const { return spacing.prod(); }
  Vec3 high() const { return low + spacing.cwiseProduct(Vec3(n[0], n[1], n[2])); }
  Box box() const { return {low, high()}; }
  Vec3 center(int i, int j, int k) const {
    return low + spacing.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
  }
};

/// Grid of a box with voxels no longer than `longest` along each axis, um.
VoxelGrid make_grid(const Box& box, double longest);

/// Layers of voxels at the faces of a box: x low, x high, y low, y high, z low, z high.
using Layers = std::array<int, 6>;

/// The same voxels with further layers around them.
VoxelGrid extend_grid(const VoxelGrid& grid, const Layers& layers);

/// A field with further layers around it, x before y before z: corners belong to the later axis.
/// @param grid     of the field, without the layers
/// @param field    [n_voxel]
/// @param outside  values of new voxels at each face
/// @return [n_voxel of the extended grid]
std::vector<double> extend_field(const VoxelGrid& grid, const Layers& layers,
                                 std::span<const double> field,
                                 const std::array<double, 6>& outside);

/// Number of voxels of make_grid, which may be too many for a grid.
double count_voxels(const Box& box, double longest);

}  // namespace acinus::substances
