#pragma once
/// A frame of a run as the label image that a microscope and a segmentation would make of it.

#include <cstdint>
#include <string>
#include <vector>

#include "imaging/label_image.hpp"
#include "imaging/voxelise.hpp"

namespace acinus::runs {

struct VoxeliseRun {
  std::string folder;   ///< of the run
  int frame = -1;       ///< from 0; -1: the last
  bool vessels = true;  ///< the vessels of the scene get the label after the last cell
  imaging::Voxelise how;
};

/// Which cell of the run has which label.
struct LabelledCell {
  imaging::Label label = 0;
  std::int64_t lineage = 0;
  double volume = 0;           ///< um^3, of its mesh or sphere
  Vec3 center = Vec3::Zero();  ///< um from the corner of the image
};

struct RunImage {
  imaging::LabelImage image;
  std::vector<LabelledCell> cell;
  imaging::Label vessels = 0;  ///< their label; 0 = none
  int frame = 0;
};

/// Deformable cells by their meshes, spheres as spheres; vessels as one surface about their
/// network.
/// @throws Error for a folder without a run, a frame that is not there, too many voxels
RunImage voxelise_run(const VoxeliseRun& options);

/// label,cell,volume_um3,x_um,y_um,z_um: a row a cell.
std::string labels_text(const RunImage& image);

}  // namespace acinus::runs
