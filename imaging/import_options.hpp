#pragma once
/// Options of an image import: image, vessels, selection of cells and their surfaces.

#include <optional>
#include <string>

#include "imaging/label_image.hpp"
#include "imaging/read_image.hpp"

namespace acinus::imaging {

struct ImportOptions {
  std::string image;
  ReadImage read;
  std::string vessels;     ///< image of the same size, not 0 inside vessels; "" = none
  Label vessel_label = 0;  ///< label of the vessels in the image; 0 = none
  /// Background label besides 0; 0: none, whatever encloses the image.
  std::optional<Label> background;
  double smallest = 0;       ///< least volume of a cell, um^3; 0: a tenth of the median
  double smoothing = 0.7;    ///< standard deviation of the Gaussian filter, voxels
  bool keep_border = false;  ///< keep cells cut by the image border, between mirror walls
  bool split = false;        ///< make every connected piece of a label a cell of its own
};

}  // namespace acinus::imaging
