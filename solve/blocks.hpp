#pragma once
/// Blocks of unknowns: eight cells with the same points, one per lane.

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace acinus::solve {

/// Points of one cell that interact; shared by all cells with the same mesh and terms.
struct BlockPattern {
  int n_point = 0;
  std::vector<std::array<int, 2>> spring;
  /// [n_spring] the other two points of the hinge about each spring; empty: no hinges
  std::vector<std::array<int, 2>> wing;
  std::vector<std::array<int, 3>> face;
  /// [n_beam] beams in bending as {end, end, rotation, rotation}; blind to a common translation of
  /// the ends.
  std::vector<std::array<int, 4>> beam{};
  /// Springs of each point as {other point, spring}, from first_spring_of[point]. Only where all
  /// sides of contacts have springs between their points (faces of a mesh); empty: not indexed.
  /// Filled by index_springs.
  std::vector<std::array<int, 2>> spring_of{};
  std::vector<std::size_t> first_spring_of{};
  /// First point that is a rotation instead of a position, in um on a lever of 1 um. -1: none.
  int n_place = -1;

  bool has_shape() const { return !spring.empty(); }
  bool has_rotations() const { return n_place >= 0; }
  int count_places() const { return has_rotations() ? n_place : n_point; }
};

/// Eight cells with one pattern.
struct Block {
  const BlockPattern* pattern = nullptr;
  std::size_t first_row = 0;    ///< first point row
  std::size_t first_shape = 0;  ///< first row of the shape; no rows without springs
  std::size_t first_spring = 0, first_hinge = 0, first_face = 0, first_beam = 0;
  bool still = false;         ///< cells that do not move: their rank-one terms are left out
  double dashpot = 0;         ///< nN s/um, friction included in the matrix of each spring
  double dashpot_across = 1;  ///< ratio of the friction across a spring to that along it
};

/// Blocks of a system, numbered from 0. Those of spheres are equal and follow each other: they are
/// kept as one, so that the spheres of other processes take no memory.
class Blocks {
 public:
  Blocks() = default;
  Blocks(std::span<const Block> blocks) {  // NOLINT: they are such blocks
    for (const Block& b : blocks) append(b);
  }
  Blocks(const std::vector<Block>& blocks) : Blocks(std::span(blocks)) {}  // NOLINT: as above
  Blocks(std::initializer_list<Block> blocks) : Blocks(std::span(blocks)) {}

  /// Appends a block; its rows and elements follow those that are there.
  void append(Block b);
  /// Appends n blocks of single points.   @pre none were appended before
  /// @param pattern  of one point, without elements
  void append_points(const BlockPattern& pattern, std::size_t n);

  std::size_t size() const { return front_.size() + n_equal_ + back_.size(); }
  bool empty() const { return size() == 0; }
  Block operator[](std::size_t b) const {
    if (b < front_.size()) return front_[b];
    b -= front_.size();
    if (b >= n_equal_) return back_[b - n_equal_];
    Block block = equal_;
    block.first_row += b;
    return block;
  }
  /// Rows and elements behind the last block.
  const Block& end() const { return end_; }

  /// First row of a block; for b = size(), the number of rows.
  std::size_t row_of(std::size_t b) const {
    if (b < front_.size()) return front_[b].first_row;
    b -= front_.size();
    if (b < n_equal_) return equal_.first_row + b;
    b -= n_equal_;
    return b < back_.size() ? back_[b].first_row : end_.first_row;
  }
  /// Block of a row.
  std::size_t block_of_row(std::size_t row) const {
    if (row < block_of_row_.size()) return static_cast<std::size_t>(block_of_row_[row]);
    const std::size_t after = row - block_of_row_.size();
    if (after < n_equal_) return front_.size() + after;
    const auto next = std::ranges::upper_bound(back_, row, {}, &Block::first_row);
    return front_.size() + n_equal_ + static_cast<std::size_t>(next - back_.begin()) - 1;
  }

  /// Blocks before those of single points, which may be changed but for their places.
  std::span<Block> front() { return front_; }

  std::size_t memory() const;  ///< bytes

 private:
  std::vector<Block> front_, back_;  ///< before and after the equal ones
  Block equal_;                      ///< first of the equal ones
  std::size_t n_equal_ = 0;
  std::vector<int> block_of_row_;  ///< [row of front_]
  Block end_;
};

}  // namespace acinus::solve
