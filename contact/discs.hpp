#pragma once
/// Bounding discs of triangles, for distance bounds of eight triangles at a time.

#include <cstddef>
#include <vector>

#include "contact/surface.hpp"
#include "core/numbers/lanes.hpp"

namespace acinus::contact {

/// Bounding discs of triangles relative to an origin near them, so that single precision keeps
/// distances to less than kRounding. The values of eight discs are stored together,
/// [group][kNumbers][lane].
struct Discs {
  static constexpr std::size_t kNumbers = 7;  ///< centre, normal, reach
  static constexpr std::size_t kStride = kNumbers * kLanes;
  std::size_t n = 0;
  std::vector<int> triangle;
  std::vector<float> number;

  /// Clears the discs and reserves storage for `most` of them.
  void reset(std::size_t most) {
    n = 0;
    const std::size_t n_group = (most + kLanes - 1) / kLanes;
    if (triangle.size() < n_group * kLanes) {
      triangle.resize(n_group * kLanes);
      number.resize(n_group * kStride);
    }
  }
  std::size_t triangle_at(int k) const { return static_cast<std::size_t>(triangle[k]); }
  static std::size_t place_of(std::size_t k) { return k / kLanes * kStride + k % kLanes; }

  void add(const SurfaceBody& b, std::size_t t, const Vec3& origin) {
    const Vec3 c = triangle_center(b, t) - origin, normal = triangle_normal(b, t);
    float* to = number.data() + place_of(n);
    for (std::size_t m = 0; m < 3; ++m) {
      to[m * kLanes] = static_cast<float>(c[static_cast<int>(m)]);
      to[(3 + m) * kLanes] = static_cast<float>(normal[static_cast<int>(m)]);
    }
    to[6 * kLanes] = static_cast<float>(triangle_reach(b, t));
    triangle[n++] = static_cast<int>(t);
  }
  void add(const Discs& other, std::size_t k) {
    const float* from = other.number.data() + place_of(k);
    float* to = number.data() + place_of(n);
    for (std::size_t m = 0; m < kNumbers; ++m) to[m * kLanes] = from[m * kLanes];
    triangle[n++] = other.triangle[k];
  }
};

}  // namespace acinus::contact
