#pragma once
/// Closed surfaces as a label image.

#include <cstdint>
#include <span>

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"

namespace acinus::imaging {

struct Voxelise {
  Vec3 voxel = Vec3::Ones();  ///< um
  double margin = 2;          ///< um, about all bodies
  double blur = 0;            ///< um, standard deviation of the Gaussian that blurs every body
  /// Standard deviation of noise where a body is half there, grainy over a voxel; falls to 0 where
  /// it is all or not at all there.
  double noise = 0;
  std::uint64_t seed = 1;
};

struct VoxelisedBodies {
  LabelImage image;
  Vec3 corner = Vec3::Zero();  ///< um, where the image's corner stands among the bodies
};

/// Body k gets label k + 1. Every voxel belongs to the body that has the largest share in it, after
/// blur and noise, or to the background if that has: walls as a segmentation would find them in a
/// picture of that resolution. The same for any number of threads.
/// @param bodies  closed, outward; may overlap
/// Throws Error if there are none or there would be too many voxels.
VoxelisedBodies voxelise(std::span<const geometry::Surface> bodies, const Voxelise& how);

}  // namespace acinus::imaging
