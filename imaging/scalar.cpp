#include "imaging/scalar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/error.hpp"
#include "core/parallel/memory.hpp"

namespace acinus::imaging {
namespace {

/// Calls visit(T{}) with the number type of a scalar.
template <class Visit>
auto with_type(Scalar type, Visit visit) {
  switch (type) {
    case Scalar::kU8:
      return visit(std::uint8_t{});
    case Scalar::kI8:
      return visit(std::int8_t{});
    case Scalar::kU16:
      return visit(std::uint16_t{});
    case Scalar::kI16:
      return visit(std::int16_t{});
    case Scalar::kU32:
      return visit(std::uint32_t{});
    case Scalar::kI32:
      return visit(std::int32_t{});
    case Scalar::kU64:
      return visit(std::uint64_t{});
    case Scalar::kI64:
      return visit(std::int64_t{});
    case Scalar::kF32:
      return visit(float{});
    case Scalar::kF64:
      break;
  }
  return visit(double{});
}

constexpr auto kMostLabel = std::numeric_limits<Label>::max();

template <class T>
bool is_label(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return value >= 0 && static_cast<double>(value) <= kMostLabel && value == std::floor(value);
  else if constexpr (std::is_signed_v<T>)
    return value >= 0 && static_cast<std::uint64_t>(value) <= kMostLabel;
  else
    return value <= kMostLabel;
}

/// Number at a byte position.
template <class T>
T value_at(std::span<const std::byte> bytes, std::size_t at, bool swap) {
  std::array<std::byte, sizeof(T)> one;
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), one.begin());
  if (swap) std::ranges::reverse(one);
  T value;
  std::memcpy(&value, one.data(), sizeof(T));
  return value;
}

/// Number of values that are not labels, from a position on.
template <class T>
std::size_t count_bad(std::span<const std::byte> bytes, bool swap) {
  std::size_t n = 0;
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
    n += is_label(value_at<T>(bytes, at, swap)) ? 0 : 1;
  return n;
}

/// Throws Error at a voxel that is not a label. @param more  other such voxels that were seen
template <class T>
[[noreturn]] void fail_at_voxel(const std::string& path, T value, std::size_t more, std::size_t at,
                                const Voxel& size) {
  const std::size_t x = at % size[0], row = at / size[0], y = row % size[1], z = row / size[1];
  throw Error(fmt::format(
      "{}: voxel ({}, {}, {}) holds {}{}; labels are whole numbers from 0, the background, to {}. "
      "Give the segmentation, not the picture it was made from.",
      path, x, y, z, +value,
      more > 0 ? fmt::format(", and at least {} more are none either", more) : "", kMostLabel));
}

}  // namespace

std::size_t bytes_of(Scalar type) {
  return with_type(type, [](auto t) { return sizeof(t); });
}

std::uint64_t most_of(Scalar type) {
  return with_type(type, [](auto t) -> std::uint64_t {
    using T = decltype(t);
    if constexpr (std::is_floating_point_v<T>)
      return std::uint64_t{1} << std::numeric_limits<T>::digits;
    else
      return static_cast<std::uint64_t>(std::numeric_limits<T>::max());
  });
}

void append_labels(const std::string& path, std::span<const std::byte> bytes, Scalar type,
                   bool swap, const Voxel& size, std::vector<Label>& out) {
  with_type(type, [&](auto t) {
    using T = decltype(t);
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
      const T value = value_at<T>(bytes, at, swap);
      if (!is_label(value))
        fail_at_voxel(path, value, count_bad<T>(bytes.subspan(at), swap) - 1, out.size(), size);
      out.push_back(static_cast<Label>(value));
    }
  });
}

void place_labels(const std::string& place, const LabelBlock& block, Scalar type, bool swap,
                  const Voxel& size, std::span<Label> out) {
  with_type(type, [&](auto t) {
    using T = decltype(t);
    for (int z = 0; z < block.size[2]; ++z)
      for (int y = 0; y < block.size[1]; ++y) {
        const std::size_t row =
            (static_cast<std::size_t>(block.first[2] + z) * size[1] + block.first[1] + y) *
                size[0] +
            block.first[0];
        std::size_t at = block.start + z * block.stride[2] + y * block.stride[1];
        for (int x = 0; x < block.size[0]; ++x, at += block.stride[0]) {
          const T value = value_at<T>(block.bytes, at, swap);
          if (!is_label(value)) fail_at_voxel(place, value, 0, row + x, size);
          out[row + x] = static_cast<Label>(value);
        }
      }
  });
}

std::size_t count_voxels(const std::string& path, const std::array<std::int64_t, 3>& size,
                         double beside) {
  constexpr std::int64_t kMostSide = 1 << 20;
  constexpr double kMostVoxels = 8589934592.0;
  const bool fits =
      std::ranges::all_of(size, [](std::int64_t n) { return n >= 1 && n <= kMostSide; }) &&
      1.0 * size[0] * size[1] * size[2] <= kMostVoxels;
  check(fits, fmt::format("{}: an image of {} x {} x {} voxels; each side must be from 1 to {}, "
                          "and all at most 2^33. Crop the image, or make its voxels larger.",
                          path, size[0], size[1], size[2], kMostSide));
  const double bytes = sizeof(Label) + beside;
  const double voxels = 1.0 * size[0] * size[1] * size[2], memory = machine_memory();
  check(bytes * voxels <= memory,
        fmt::format(
            "{}: an image of {} x {} x {} voxels may take {:.3g} GB; this machine has {:.3g}. "
            "Crop the image, or make its voxels larger.",
            path, size[0], size[1], size[2], 1e-9 * bytes * voxels, 1e-9 * memory));
  return size[0] * size[1] * size[2];
}

}  // namespace acinus::imaging
