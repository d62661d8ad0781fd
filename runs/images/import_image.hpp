#pragma once
/// A scene from a label image: its cells as deformable cells or spheres, its vessels as a surface.

#include <array>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"
#include "runs/images/import_options.hpp"

namespace acinus::runs {

/// A label, or a piece of one, that is no cell of the scene.
struct LeftOut {
  imaging::Label label = 0;
  std::size_t n_voxel = 0;
  Vec3 center = Vec3::Zero();  ///< um
  std::string why;
};

struct ImportedCell {
  imaging::Label label = 0;
  std::size_t n_voxel = 0;
  double volume = 0;           ///< um^3, of its voxels
  Vec3 center = Vec3::Zero();  ///< um, of its voxels
  int neighbours = 0;          ///< cells that touch it in the image
  bool at_border = false, at_vessel = false;
  geometry::Surface surface;
};

struct ImportedTissue {
  imaging::Voxel size{};
  Vec3 voxel = Vec3::Zero();       ///< um
  std::vector<ImportedCell> cell;  ///< by label
  std::vector<LeftOut> left_out;   ///< by label, the larger first
  std::vector<geometry::Surface> vessel;
  std::vector<std::array<imaging::Label, 2>> touching;  ///< pairs of kept cells
  std::vector<std::string> warned;
};

/// Reads, sorts out and makes surfaces. um from the corner of the image.
/// @throws Error for an image that cannot be used or holds no cell that can be kept
ImportedTissue import_image(const ImportOptions& options);

/// Writes scene.json, cells.vtk, cells.csv, and where there are any vessels.vtk and left_out.csv,
/// into a new folder. The scene is read once more, so that it surely runs.
/// @return paths written, the scene first
/// @throws Error if the folder exists (kBadInput), or the disk refuses (kFileError)
std::vector<std::string> write_tissue(const ImportedTissue& tissue, const ImportOptions& options,
                                      const std::string& folder);

}  // namespace acinus::runs
