#pragma once
/// Frame of a run as a label image, such as microscopy and segmentation would give.

#include <string>

#include "imaging/voxelise_frame.hpp"

namespace acinus::runs {

/// Options of voxelising a frame.
struct VoxeliseRun {
  std::string folder;   ///< run folder
  int frame = -1;       ///< frame number from 0; -1: the last
  bool vessels = true;  ///< include the vessels of the scene, with the label after the last cell
  imaging::Voxelise how;
};

/// Label image with the number of its frame.
struct RunImage {
  imaging::CellImage cells;
  int frame = 0;
};

/// Voxelises a frame: deformable cells by their meshes, spheres as spheres, vessels as one surface
/// about their network.
/// @throws Error for a folder without a run, a missing frame, too many voxels
RunImage voxelise_run(const VoxeliseRun& options);

}  // namespace acinus::runs
