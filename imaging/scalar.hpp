#pragma once
/// Number types of image files, and their conversion to labels.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "imaging/label_rows.hpp"

namespace acinus::imaging {

enum class Scalar { kU8, kI8, kU16, kI16, kU32, kI32, kU64, kI64, kF32, kF64 };

std::size_t bytes_of(Scalar type);

/// Largest whole number that a type holds without a gap below it; at most 2^64 - 1.
std::uint64_t most_of(Scalar type);

/// Box of an image, in bytes of which the numbers stand at any distance.
struct LabelBlock {
  std::span<const std::byte> bytes;
  std::size_t start = 0;                ///< bytes before its first number
  std::array<std::size_t, 3> stride{};  ///< bytes between neighbours along x, y, z
  Voxel first{}, size{};                ///< its first voxel in the image, its voxels
};

/// Appends a box to the lines of an image. Threads may append boxes of different lines at once.
/// @param fill  label of voxels between the end of a line and the box
/// @pre the box is behind the present end of its lines
/// Throws Error, with `place` and the voxel, at a number that is not a whole one from 0 to 2^32
/// - 1, and if the process takes nearly all memory of the machine.
void append_labels(const std::string& place, const LabelBlock& block, Scalar type, bool swap,
                   Label fill, LabelRows& out);

/// Throws Error if `used` bytes of memory are nearly all there are. @param most  bytes
void check_memory(const std::string& place, double used, double most);

/// Number of voxels. Throws Error unless all sides are from 1 to 2^20, there are at most 2^33, and
/// this machine has memory for the lines of such an image.
std::size_t count_voxels(const std::string& path, const std::array<std::int64_t, 3>& size);

}  // namespace acinus::imaging
