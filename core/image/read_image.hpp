#pragma once
/// Reads label images: segmentations, one number a cell.

#include <optional>
#include <string>

#include "core/image/label_image.hpp"

namespace acinus::image {

struct ReadImage {
  std::string dataset;        ///< HDF5: where in the file; "" = the only one
  std::int64_t channel = -1;  ///< from 0, where there are several
  /// um, sides of a voxel, whatever the file says.
  std::optional<Vec3> voxel;
  double unit = 0;  ///< um in a unit of the file, where it has sizes without a unit; 0 = not said
};

/// Reads TIFF stacks (.tif, .tiff; voxel sizes of OME or ImageJ), NIfTI (.nii, .nii.gz, .hdr),
/// MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr) and HDF5 (.h5, .hdf5; attribute element_size_um).
/// Throws Error (kBadInput) with the path and place: what is wrong, not supported, or not said.
LabelImage read_image(const std::string& path, const ReadImage& how);

}  // namespace acinus::image
