#pragma once
/// Storage of a candidate list: points of one surface, each with triangles of another.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace acinus::contact {

/// Candidate list in full precision, as it is made.
struct WideCandidates {
  std::vector<int> point;
  std::vector<float> gap;            ///< um, [point]; empty: all 0
  std::vector<std::uint32_t> start;  ///< [point + 1] first of its triangles
  std::vector<int> triangle;
  std::vector<float> bound;  ///< um, [triangle], not negative; empty: all 0

  void clear() {
    point.clear();
    gap.clear();
    start.clear();
    triangle.clear();
    bound.clear();
  }
};

/// Candidate list in one array: a point has six bytes and a triangle four, or twice as many where a
/// number is above 65,535. Lengths are rounded towards zero by less than 1 in 128, so that bounds
/// remain bounds.
class CandidateList {
 public:
  bool empty() const { return n_point_ == 0; }
  std::size_t n_point() const { return n_point_; }
  std::size_t n_triangle() const { return n_triangle_; }

  int point_at(std::size_t p) const {
    return static_cast<int>(wide_ ? word_[p] : word_[p] >> kHalf);
  }
  float gap_at(std::size_t p) const {
    return std::bit_cast<float>(wide_ ? word_[n_point_ + p] : word_[p] << kHalf);
  }
  /// Range of the triangles of a point.
  std::uint32_t begin_of(std::size_t p) const { return p == 0 ? 0 : end_of(p - 1); }
  std::uint32_t end_of(std::size_t p) const {
    if (wide_) return word_[2 * n_point_ + p];
    return (word_[n_point_ + p / 2] >> (p % 2 * kHalf)) & kLow;
  }
  int triangle_at(std::size_t k) const {
    const std::uint32_t low = word_[first_ + k] & kLow;
    return static_cast<int>(wide_ ? low | word_[first_ + n_triangle_ + k] << kHalf : low);
  }
  float bound_at(std::size_t k) const { return std::bit_cast<float>(word_[first_ + k] & ~kLow); }

  void assign(const WideCandidates& from) {
    n_point_ = static_cast<std::uint32_t>(from.point.size());
    n_triangle_ = static_cast<std::uint32_t>(from.triangle.size());
    const auto is_large = [](int number) { return static_cast<std::uint32_t>(number) > kLow; };
    wide_ = n_triangle_ > kLow || std::ranges::any_of(from.point, is_large) ||
            std::ranges::any_of(from.triangle, is_large);
    first_ = wide_ ? 3 * n_point_ : n_point_ + (n_point_ + 1) / 2;
    set_length(first_ + (wide_ ? 2 : 1) * n_triangle_);
    for (std::uint32_t p = 0; p < n_point_; ++p) {
      const auto point = static_cast<std::uint32_t>(from.point[p]);
      const std::uint32_t gap = from.gap.empty() ? 0 : cut(from.gap[p]), end = from.start[p + 1];
      if (wide_) {
        word_[p] = point;
        word_[n_point_ + p] = gap;
        word_[2 * n_point_ + p] = end;
      } else {
        word_[p] = point << kHalf | gap >> kHalf;
        word_[n_point_ + p / 2] |= end << (p % 2 * kHalf);
      }
    }
    for (std::uint32_t k = 0; k < n_triangle_; ++k) {
      const auto triangle = static_cast<std::uint32_t>(from.triangle[k]);
      word_[first_ + k] = (triangle & kLow) | (from.bound.empty() ? 0 : cut(from.bound[k]));
      if (wide_) word_[first_ + n_triangle_ + k] = triangle >> kHalf;
    }
  }

  /// Memory of the array, bytes.
  std::size_t memory() const { return word_.capacity() * sizeof(std::uint32_t); }

 private:
  /// Zeros. A list made again is about as long as before and stays where it is: arrays that move at
  /// every change of their length leave gaps between those of others.
  void set_length(std::size_t n) {
    if (n > word_.capacity() || n < word_.capacity() / 4 * 3) {
      word_ = std::vector<std::uint32_t>();  // before the new array is there
      word_.reserve(n + n / 16);
    }
    word_.assign(n, 0);
  }
  static constexpr std::uint32_t kLow = 0xffff, kHalf = 16;
  /// Bits of a float without those of the lower half.
  static std::uint32_t cut(float x) { return std::bit_cast<std::uint32_t>(x) & ~kLow; }

  /// Narrow: [point] number and gap in the halves of a word, [point] ends in half a word each,
  /// [triangle] bound and number in the halves of a word. Wide: [point] numbers, gaps, ends,
  /// [triangle] bound and lower half of the number, [triangle] upper half.
  std::vector<std::uint32_t> word_;
  std::uint32_t n_point_ = 0, n_triangle_ = 0;
  std::uint32_t first_ = 0;  ///< word of the first triangle
  bool wide_ = false;
};

}  // namespace acinus::contact
