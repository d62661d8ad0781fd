#pragma once
/// Cells and vessels of a label image as closed surfaces.

#include <array>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "imaging/import_options.hpp"
#include "imaging/label_image.hpp"

namespace acinus::imaging {

/// Label, or piece of a label, without a cell.
struct LeftOut {
  Label label = 0;
  std::size_t n_voxel = 0;
  Vec3 center = Vec3::Zero();  ///< centroid, um
  std::string why;
};

struct ImportedCell {
  Label label = 0;
  std::size_t n_voxel = 0;
  double volume = 0;           ///< volume of its voxels, um^3
  Vec3 center = Vec3::Zero();  ///< centroid of its voxels, um
  int neighbours = 0;          ///< number of touching cells in the image
  bool at_border = false, at_vessel = false;
  geometry::Surface surface;
};

struct ImportedTissue {
  Voxel size{};
  Vec3 voxel = Vec3::Zero();       ///< sides of a voxel, um
  std::vector<ImportedCell> cell;  ///< ascending labels
  std::vector<LeftOut> left_out;   ///< ascending labels, larger pieces first
  std::vector<geometry::Surface> vessel;
  std::vector<std::array<Label, 2>> touching;  ///< touching pairs among `cell`
  std::vector<std::string> warnings;
};

/// Reads a label image, selects the cells and triangulates their surfaces. Coordinates are um from
/// the corner of the image.
/// @throws Error for an unusable image, or one without a cell to keep
ImportedTissue import_image(const ImportOptions& options);

}  // namespace acinus::imaging
