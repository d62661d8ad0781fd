#pragma once
/// Cells and vessels of a label image as closed surfaces.

#include <array>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"
#include "runs/images/import_options.hpp"

namespace acinus::runs {

/// Label, or piece of a label, without a cell.
struct LeftOut {
  imaging::Label label = 0;
  std::size_t n_voxel = 0;
  Vec3 center = Vec3::Zero();  ///< centroid, um
  std::string why;
};

struct ImportedCell {
  imaging::Label label = 0;
  std::size_t n_voxel = 0;
  double volume = 0;           ///< volume of its voxels, um^3
  Vec3 center = Vec3::Zero();  ///< centroid of its voxels, um
  int neighbours = 0;          ///< number of touching cells in the image
  bool at_border = false, at_vessel = false;
  geometry::Surface surface;
};

struct ImportedTissue {
  imaging::Voxel size{};
  Vec3 voxel = Vec3::Zero();       ///< sides of a voxel, um
  std::vector<ImportedCell> cell;  ///< ascending labels
  std::vector<LeftOut> left_out;   ///< ascending labels, larger pieces first
  std::vector<geometry::Surface> vessel;
  std::vector<std::array<imaging::Label, 2>> touching;  ///< touching pairs among `cell`
  std::vector<std::string> warned;
};

/// Reads a label image, selects the cells and triangulates their surfaces. Coordinates are um from
/// the corner of the image.
/// @throws Error for an unusable image, or one without a cell to keep
ImportedTissue import_image(const ImportOptions& options);

/// Writes scene.json, cells.vtk, cells.csv, and where there are any vessels.vtk and left_out.csv,
/// into a new folder. The scene is read once more, so that it surely runs.
/// @return paths written, the scene first
/// @throws Error if the folder exists (kBadInput), or the disk refuses (kFileError)
std::vector<std::string> write_tissue(const ImportedTissue& tissue, const ImportOptions& options,
                                      const std::string& folder);

}  // namespace acinus::runs
