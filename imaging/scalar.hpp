#pragma once
/// Number types of image files, and their conversion to labels.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "imaging/label_image.hpp"

namespace acinus::imaging {

enum class Scalar { kU8, kI8, kU16, kI16, kU32, kI32, kU64, kI64, kF32, kF64 };

std::size_t bytes_of(Scalar type);

/// Largest whole number that a type holds without a gap below it; at most 2^64 - 1.
std::uint64_t most_of(Scalar type);

/// Appends numbers as labels.
/// @param bytes  a multiple of bytes_of(type)
/// @param swap   the other byte order than this machine's
/// @param size   of the image, for messages
/// Throws Error, with the voxel, at a number that is not a whole one from 0 to 2^32 - 1.
void append_labels(const std::string& path, std::span<const std::byte> bytes, Scalar type,
                   bool swap, const Voxel& size, std::vector<Label>& out);

/// Box of an image, in bytes of which the numbers stand at any distance.
struct LabelBlock {
  std::span<const std::byte> bytes;
  std::size_t start = 0;                ///< bytes before its first number
  std::array<std::size_t, 3> stride{};  ///< bytes between neighbours along x, y, z
  Voxel first{}, size{};                ///< its first voxel in the image, its voxels
};

/// Copies a box into the labels of an image.
/// @param size  of the image
/// Throws Error, with `place` and the voxel, at a number that is not a whole one from 0 to 2^32
/// - 1.
void place_labels(const std::string& place, const LabelBlock& block, Scalar type, bool swap,
                  const Voxel& size, std::span<Label> out);

/// Number of voxels. Throws Error unless all sides are from 1 to 2^20, there are at most 2^33, and
/// this machine has memory for their labels.
/// @param beside  bytes a voxel that a reader holds beside the labels
std::size_t count_voxels(const std::string& path, const std::array<std::int64_t, 3>& size,
                         double beside = 2 * sizeof(std::uint64_t));

}  // namespace acinus::imaging
