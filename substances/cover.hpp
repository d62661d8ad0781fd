#pragma once
/// Covers of bodies on a grid: the fractions of voxels and of their faces inside a body.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "substances/grid.hpp"

namespace acinus::substances {

struct CoveredPart {
  std::size_t at = 0;   ///< voxel, or face as VoxelGrid::face_index
  double fraction = 0;  ///< of its volume or area, 0 to 1
};

/// Parts of a grid inside a body. What is outside the box counts nowhere.
struct Cover {
  std::vector<CoveredPart> volume;
  std::array<std::vector<CoveredPart>, 3> face;  ///< per axis across the face
};

/// Cover of a sphere: exact areas of faces; volumes by Gauss' rule over exact areas of sections.
Cover cover_sphere(const VoxelGrid& grid, const Vec3& center, double radius);

/// Cover of the inside of a closed surface. Lines along an axis, at least four per voxel and twelve
/// across the body, are cut exactly.
Cover cover_surface(const VoxelGrid& grid, std::span<const Vec3> node,
                    std::span<const std::array<int, 3>> triangle);

/// Cover of all points at a distance below 0. Voxels and faces that the surface may pass are
/// sampled at points; each counts as a box of its own, cut by a plane at its distance.
/// @param distance  um, signed; at most the true distance in size
Cover cover_region(const VoxelGrid& grid, const std::function<double(const Vec3&)>& distance);

}  // namespace acinus::substances
