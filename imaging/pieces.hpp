#pragma once
/// Connected pieces of the labels of an image.

#include <vector>

#include "imaging/label_rows.hpp"

namespace acinus::imaging {

/// Connected piece: voxels of one label that share faces.
struct Piece {
  Label label = 0;
  std::size_t n_voxel = 0;
  Voxel low{}, high{};         ///< corners of its bounding box, both included
  Vec3 center = Vec3::Zero();  ///< um, of its voxels
  bool at_border = false;      ///< touches the border of the image, so part of it may be outside
};

struct Pieces {
  std::vector<Piece> piece;  ///< by label, the largest of a label first
  std::vector<int> of_row;   ///< piece of every row, in the order of the image; -1: background
};

/// Finds the connected pieces of all labels. Cost: linear in rows, of which there are at most 2^31.
/// Throws Error if there are more.
Pieces find_pieces(const LabelRows& image);

/// Pairs of labels, the lower first and ascending, that share at least `least` faces of voxels. The
/// background has no pairs.
std::vector<std::array<Label, 2>> find_touching(const LabelRows& image, int least);

}  // namespace acinus::imaging
