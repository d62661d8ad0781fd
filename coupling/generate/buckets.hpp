#pragma once
/// Spatial hashing for the generators: range queries without a search over all items.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

/// Distance from a point to the segment a-b, um.
inline double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  double t = length2 > 0 ? (point - a).dot(along) / length2 : 0.0;
  t = t < 0 ? 0 : (t > 1 ? 1 : t);
  return (point - a - t * along).norm();
}

/// Points and segments sorted into cubes of side `reach`. Each item is stored in every cube within
/// `reach` of it, so a query reads one cube.
class Buckets {
 public:
  explicit Buckets(double reach) : reach_(reach) {}

  /// Adds a segment; a point is a segment of length 0.
  void add(const Vec3& a, const Vec3& b) {
    const int index = static_cast<int>(item_.size());
    item_.push_back({a, b});
    const Vec3 margin = Vec3::Constant(reach_);
    const Cube low = cube_of(a.cwiseMin(b) - margin), high = cube_of(a.cwiseMax(b) + margin);
    for (std::int64_t x = low.x; x <= high.x; ++x)
      for (std::int64_t y = low.y; y <= high.y; ++y)
        for (std::int64_t z = low.z; z <= high.z; ++z) bucket_[key({x, y, z})].push_back(index);
  }

  /// True if an item lies closer to the point than `distance`, which must not exceed reach.
  bool any_within(const Vec3& point, double distance) const {
    const auto found = bucket_.find(key(cube_of(point)));
    if (found == bucket_.end()) return false;
    for (const int index : found->second)
      if (distance_to_segment(point, item_[index].a, item_[index].b) < distance) return true;
    return false;
  }

 private:
  struct Item {
    Vec3 a, b;
  };
  struct Cube {
    std::int64_t x, y, z;
  };
  Cube cube_of(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / reach_)),
            static_cast<std::int64_t>(std::floor(p.y() / reach_)),
            static_cast<std::int64_t>(std::floor(p.z() / reach_))};
  }
  /// Key of a cube, 21 bits an axis: unique for domains of fewer than two million cubes a side.
  static std::uint64_t key(const Cube& c) {
    constexpr std::int64_t kHalf = 1 << 20;
    return (static_cast<std::uint64_t>(c.x + kHalf) << 42) |
           (static_cast<std::uint64_t>(c.y + kHalf) << 21) |
           static_cast<std::uint64_t>(c.z + kHalf);
  }

  double reach_;
  std::vector<Item> item_;
  std::unordered_map<std::uint64_t, std::vector<int>> bucket_;
};

}  // namespace acinus::coupling
