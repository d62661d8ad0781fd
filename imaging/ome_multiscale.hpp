#pragma once
/// OME-Zarr metadata, versions 0.4 and 0.5: label images of a folder, their axes, levels and sizes.

#include <string>
#include <vector>

namespace acinus::imaging {

struct OmeAxis {
  std::string name, type, unit;  ///< "" where not stated
};

/// One resolution of an image.
struct OmeLevel {
  std::string path;  ///< of its array, in the folder of the image
  /// Sides of a voxel in units of the axes, and position of the first voxel; one number an axis.
  /// Those of the image and of the level together. Empty scale: not stated.
  std::vector<double> scale, translation;
  std::string fault;  ///< reason why there is no scale
};

/// Image with several resolutions, the finest first.
struct OmeMultiscale {
  std::vector<OmeAxis> axis;  ///< in the order of the arrays
  std::vector<OmeLevel> level;
  bool is_label = false;  ///< the metadata say that it is a label image
  std::string file;       ///< with the metadata
};

/// Finds the folder of the label image that is asked for.
/// @param said     name of the label image, or a path in the folder; "": the only one
/// @param lenient  the name counts only where there are several
/// Throws Error, with the names to choose from.
std::string choose_ome_image(const std::string& folder, const std::string& said, bool lenient);

/// Reads the metadata of an image. Throws Error at what is wrong or not supported.
OmeMultiscale read_multiscale(const std::string& folder);

}  // namespace acinus::imaging
