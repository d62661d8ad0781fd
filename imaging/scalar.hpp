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

/// Number of voxels. Throws Error unless all sides are from 1 to 2^20 and there are at most 2^33.
std::size_t count_voxels(const std::string& path, const std::array<std::int64_t, 3>& size);

}  // namespace acinus::imaging
