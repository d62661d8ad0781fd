#pragma once
/// Shares of bodies in the voxels of a grid: where a cell exchanges substances with its
/// surroundings.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "substances/grid.hpp"

namespace acinus::substances {

struct VoxelShare {
  std::size_t voxel = 0;
  double volume = 0;  ///< um^3 of the body in the voxel
};

/// Shares of many bodies, in order: those of body k are [start[k], start[k + 1]).
struct Shares {
  std::vector<std::size_t> start{0};
  std::vector<VoxelShare> share;

  std::size_t n_body() const { return start.size() - 1; }
  std::span<const VoxelShare> of(std::size_t body) const {
    return std::span(share).subspan(start[body], start[body + 1] - start[body]);
  }
  void add(std::span<const VoxelShare> body);
};

/// Shares of a sphere. They sum to its volume: vertical columns, at least eight across a diameter,
/// are cut exactly by the voxels and scaled together. What is outside the box counts in the voxel
/// nearest to it.
std::vector<VoxelShare> share_sphere(const VoxelGrid& grid, const Vec3& center, double radius);

/// The same of the inside of a closed surface of triangles.
std::vector<VoxelShare> share_surface(const VoxelGrid& grid, std::span<const Vec3> node,
                                      std::span<const std::array<int, 3>> triangle);

/// Shares by area in the voxels that a surface passes, scaled to the volume of the body: where a
/// cell exchanges what is kept out of it. Points a third of a voxel apart stand for the surface.
std::vector<VoxelShare> share_sphere_by_area(const VoxelGrid& grid, const Vec3& center,
                                             double radius);
std::vector<VoxelShare> share_surface_by_area(const VoxelGrid& grid, std::span<const Vec3> node,
                                              std::span<const std::array<int, 3>> triangle);

/// Mean of a field over the shares of a body.   @param field  [n_voxel]
double mean_over(std::span<const VoxelShare> body, std::span<const double> field);

}  // namespace acinus::substances
