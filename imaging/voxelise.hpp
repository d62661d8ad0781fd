#pragma once
/// Conversion of closed surfaces to a label image.

#include <cstdint>
#include <span>

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"

namespace acinus::imaging {

struct Voxelise {
  Vec3 voxel = Vec3::Ones();  ///< um
  double margin = 2;          ///< um, round all bodies
  double blur = 0;            ///< um, standard deviation of the Gaussian blur of every body
  /// Standard deviation of the noise, with a grain of one voxel, where a body fills half of it;
  /// falls to 0 where it fills all or nothing.
  double noise = 0;
  std::uint64_t seed = 1;
};

struct VoxelisedBodies {
  LabelImage image;
  Vec3 corner = Vec3::Zero();  ///< um, the image's corner in the coordinates of the bodies
};

/// Label image of bodies; body k gets label k + 1. Every voxel belongs to the body with the largest
/// share in it, after blur and noise, or to the background if that has: walls as a segmentation of
/// a picture of that resolution. The same for any number of threads.
/// @param bodies  closed, outward; may overlap
/// Throws Error if there are none or there would be too many voxels.
VoxelisedBodies voxelise(std::span<const geometry::Surface> bodies, const Voxelise& how);

}  // namespace acinus::imaging
