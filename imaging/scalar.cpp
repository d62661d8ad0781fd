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

/// Number of a voxel of a block.
template <class T>
T number_at(const LabelBlock& block, const Voxel& v, bool swap) {
  return value_at<T>(
      block.bytes,
      block.start + v[0] * block.stride[0] + v[1] * block.stride[1] + v[2] * block.stride[2], swap);
}

/// Throws Error at a voxel of a block that is not a label.
template <class T>
[[noreturn]] void fail_at_voxel(const std::string& place, const LabelBlock& block, bool swap,
                                const Voxel& v) {
  std::size_t bad = 0;
  for (int z = 0; z < block.size[2]; ++z)
    for (int y = 0; y < block.size[1]; ++y)
      for (int x = 0; x < block.size[0]; ++x)
        bad += is_label(number_at<T>(block, {x, y, z}, swap)) ? 0 : 1;
  throw Error(fmt::format(
      "{}: voxel ({}, {}, {}) holds {}{}; labels are whole numbers from 0, the background, to {}. "
      "Give the segmentation, not the picture it was made from.",
      place, block.first[0] + v[0], block.first[1] + v[1], block.first[2] + v[2],
      +number_at<T>(block, v, swap),
      bad > 1 ? fmt::format(", and at least {} more are none either", bad - 1) : "", kMostLabel));
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

void append_labels(const std::string& place, const LabelBlock& block, Scalar type, bool swap,
                   Label fill, LabelRows& out) {
  with_type(type, [&](auto t) {
    using T = decltype(t);
    std::vector<Label> label(block.size[0]);
    for (int z = 0; z < block.size[2]; ++z)
      for (int y = 0; y < block.size[1]; ++y) {
        for (int x = 0; x < block.size[0]; ++x) {
          const T value = number_at<T>(block, {x, y, z}, swap);
          if (!is_label(value)) fail_at_voxel<T>(place, block, swap, {x, y, z});
          label[x] = static_cast<Label>(value);
        }
        append_voxels(block.first[0], label, fill,
                      out.line[out.line_index(block.first[1] + y, block.first[2] + z)]);
      }
  });
  constexpr std::size_t kCheckEvery = 1 << 22;  // voxels
  thread_local std::size_t unchecked = 0;
  unchecked += static_cast<std::size_t>(block.size[0]) * block.size[1] * block.size[2];
  if (unchecked < kCheckEvery) return;
  unchecked = 0;
  check_memory(place, static_cast<double>(rss_bytes()), machine_memory());
}

void check_memory(const std::string& place, double used, double most) {
  constexpr double kMostShare = 0.9;
  check(used <= kMostShare * most,
        fmt::format(
            "{}: labels take {:.3g} GB of memory already; this machine has {:.3g}. Rows of voxels "
            "with one label take 8 bytes each: is it a segmentation? Remove specks, crop the "
            "image, or make its voxels larger.",
            place, 1e-9 * used, 1e-9 * most));
}

std::size_t count_voxels(const std::string& path, const std::array<std::int64_t, 3>& size) {
  constexpr std::int64_t kMostSide = 1 << 20;
  constexpr double kMostVoxels = 8589934592.0;
  const bool fits =
      std::ranges::all_of(size, [](std::int64_t n) { return n >= 1 && n <= kMostSide; }) &&
      1.0 * size[0] * size[1] * size[2] <= kMostVoxels;
  check(fits, fmt::format("{}: an image of {} x {} x {} voxels; each side must be from 1 to {}, "
                          "and all at most 2^33. Crop the image, or make its voxels larger.",
                          path, size[0], size[1], size[2], kMostSide));
  constexpr double kLeastBytes = sizeof(LabelLine) + 32;  // of a line with one row
  const double bytes = kLeastBytes * size[1] * size[2], memory = machine_memory();
  check(bytes <= memory,
        fmt::format("{}: {} x {} lines along x take {:.3g} GB or more; this machine has {:.3g}. "
                    "Crop the image, or make its voxels larger.",
                    path, size[1], size[2], 1e-9 * bytes, 1e-9 * memory));
  return size[0] * size[1] * size[2];
}

}  // namespace acinus::imaging
