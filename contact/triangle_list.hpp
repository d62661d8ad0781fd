#pragma once
/// Compact storage of candidate lists: triangles with lower bounds of their distances.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace acinus::contact {

/// Number in two bytes, the upper half of a float: rounded towards zero by less than 1 in 128.
class HalfFloat {
 public:
  HalfFloat() = default;
  explicit HalfFloat(float value)
      : bits_(static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(value) >> 16)) {}
  float value() const { return std::bit_cast<float>(std::uint32_t{bits_} << 16); }

 private:
  std::uint16_t bits_ = 0;
};

/// Triangles, and a lower bound of the distance of each, um: four bytes an entry, or six where a
/// triangle has a number above 65,535.
class TriangleList {
 public:
  std::size_t size() const { return entry_.size(); }
  int triangle_at(std::size_t k) const {
    const std::uint32_t low = entry_[k] & kLow;
    return static_cast<int>(high_.empty() ? low : low | std::uint32_t{high_[k]} << 16);
  }
  float bound_at(std::size_t k) const { return std::bit_cast<float>(entry_[k] & ~kLow); }

  /// @param bound  um, not negative, rounded down; empty: all 0
  void assign(std::span<const int> triangle, std::span<const float> bound) {
    const std::size_t n = triangle.size();
    entry_ = std::vector<std::uint32_t>(n);
    bool wide = false;
    for (std::size_t k = 0; k < n; ++k) {
      const auto t = static_cast<std::uint32_t>(triangle[k]);
      const std::uint32_t above = bound.empty() ? 0 : std::bit_cast<std::uint32_t>(bound[k]);
      entry_[k] = (t & kLow) | (above & ~kLow);
      wide = wide || t > kLow;
    }
    high_ = std::vector<std::uint16_t>(wide ? n : 0);
    for (std::size_t k = 0; k < high_.size(); ++k)
      high_[k] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(triangle[k]) >> 16);
  }
  /// Memory of the list, bytes.
  std::size_t memory() const {
    return entry_.capacity() * sizeof(std::uint32_t) + high_.capacity() * sizeof(std::uint16_t);
  }

 private:
  static constexpr std::uint32_t kLow = 0xffff;
  std::vector<std::uint32_t> entry_;  ///< upper half: of the bound; lower half: of the triangle
  std::vector<std::uint16_t> high_;   ///< upper half of the triangle; empty: all 0
};

}  // namespace acinus::contact
