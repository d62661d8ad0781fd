#pragma once
/// Options of an import: the image, what in it is a cell, and how cells are made.

#include <optional>
#include <string>

#include "imaging/label_image.hpp"
#include "imaging/read_image.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {

struct ImportOptions {
  std::string image;
  imaging::ReadImage read;
  std::string vessels;              ///< an image of the same size, not 0 inside vessels; "" = none
  imaging::Label vessel_label = 0;  ///< or the label of vessels in the image; 0 = none
  /// A label that is background besides 0; 0: no other is, however it looks.
  std::optional<imaging::Label> background;
  CellModel model = CellModel::kDcm;
  int nodes = 162;           ///< of a cell's mesh
  double smallest = 0;       ///< um^3; smaller labels are specks; 0: a tenth of the median
  double smoothing = 0.7;    ///< voxels, standard deviation
  bool keep_border = false;  ///< cells cut off by the border stay, between mirror walls
  bool split = false;        ///< every connected piece of a label is a cell of its own
};

}  // namespace acinus::runs
