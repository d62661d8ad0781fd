#pragma once
/// Reader of label images: segmentations, one number a cell.

#include <optional>
#include <string>
#include <vector>

#include "imaging/label_rows.hpp"

namespace acinus::imaging {

struct ReadImage {
  std::string dataset{};      ///< HDF5, OME-Zarr: path in the file; "" = the only one
  std::int64_t level = -1;    ///< OME-Zarr: resolution, from 0, the finest; -1: not given
  std::int64_t channel = -1;  ///< from 0, where there are several
  /// Sides of a voxel, um; they override the file.
  std::optional<Vec3> voxel{};
  double unit = 0;  ///< um in a unit of the file's sizes, overrides the file; 0 = not given
  /// Second image, read with the choices made for a first: dataset, channel and level count only
  /// where the file has several.
  bool second = false;
};

/// Reads TIFF stacks (.tif, .tiff; voxel sizes of OME or ImageJ), NIfTI (.nii, .nii.gz, .hdr),
/// MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr), HDF5 (.h5, .hdf5; attribute element_size_um) and
/// folders of OME-Zarr.
/// Each statement of the file (docs/howto/images.md lists them) is followed, or `notes` gets a
/// line. Throws Error with the path and place where something is wrong, not supported,
/// contradictory or missing; and at a choice in `how` that has no effect. Files are read block by
/// block: a chunk per thread, a page, or some MB are in memory beside the rows.
LabelRows read_image(const std::string& path, const ReadImage& how,
                     std::vector<std::string>* notes = nullptr);

}  // namespace acinus::imaging
