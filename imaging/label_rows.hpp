#pragma once
/// Label image as rows of voxels with one label, for images larger than the memory: 8 bytes a row.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "imaging/label_image.hpp"

namespace acinus::imaging {

/// Row of voxels of one label along x. It begins where the row before it ends.
struct LabelRow {
  int end = 0;  ///< x behind its last voxel
  Label label = 0;
  bool operator==(const LabelRow&) const = default;
};

/// All voxels of one y and z, by ascending x.
using LabelLine = std::vector<LabelRow>;

/// Label image in rows. A line covers all x once it is complete.
struct LabelRows : VoxelLattice {
  std::vector<LabelLine> line;   ///< [z][y]
  std::uint64_t most_label = 0;  ///< largest number that the number type of the file can hold

  std::size_t line_index(int y, int z) const { return static_cast<std::size_t>(z) * size[1] + y; }
  std::size_t count_rows() const;
};

/// First x of a row.
inline int first_of(const LabelLine& line, std::size_t row) {
  return row == 0 ? 0 : line[row - 1].end;
}

/// Appends a row to a line, or extends the last one if it has the same label.
void append_row(int end, Label label, LabelLine& line);

/// Appends voxels that begin at x = first. A gap before them gets the label `fill`.
/// @pre first is not below the end of the line
void append_voxels(int first, std::span<const Label> label, Label fill, LabelLine& line);

/// Gives the label `fill` to the missing end of every line.
void complete_lines(Label fill, LabelRows& image);

/// Rows of an image with a number per voxel.
LabelRows make_rows(const LabelImage& image);

/// Calls visit(first, end, row of a, row of b) for every stretch along x that is in one row of each
/// of two lines, by ascending x. @pre both lines are complete
template <class Visit>
void visit_overlaps(const LabelLine& a, const LabelLine& b, const Visit& visit) {
  int first = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const int end = std::min(a[i].end, b[j].end);
    visit(first, end, i, j);
    if (a[i].end == end) ++i;
    if (b[j].end == end) ++j;
    first = end;
  }
}

}  // namespace acinus::imaging
