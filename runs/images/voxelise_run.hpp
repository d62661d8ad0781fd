#pragma once
/// Frame of a run as a label image, such as microscopy and segmentation would give.

#include <cstdint>
#include <string>
#include <vector>

#include "imaging/label_image.hpp"
#include "imaging/voxelise.hpp"

namespace acinus::runs {

struct VoxeliseRun {
  std::string folder;   ///< run folder
  int frame = -1;       ///< frame number from 0; -1: the last
  bool vessels = true;  ///< include the vessels of the scene, with the label after the last cell
  imaging::Voxelise how;
};

/// Label and measures of one cell of the image.
struct LabelledCell {
  imaging::Label label = 0;
  std::int64_t lineage = 0;
  double volume = 0;           ///< volume of its mesh or sphere, um^3
  Vec3 center = Vec3::Zero();  ///< centroid, um from the corner of the image
};

struct RunImage {
  imaging::LabelImage image;
  std::vector<LabelledCell> cell;
  imaging::Label vessels = 0;  ///< label of the vessels; 0 = none
  int frame = 0;
};

/// Voxelises a frame: deformable cells by their meshes, spheres as spheres, vessels as one surface
/// about their network.
/// @throws Error for a folder without a run, a missing frame, too many voxels
RunImage voxelise_run(const VoxeliseRun& options);

/// CSV table with a row per cell: label,cell,volume_um3,x_um,y_um,z_um.
std::string labels_text(const RunImage& image);

}  // namespace acinus::runs
