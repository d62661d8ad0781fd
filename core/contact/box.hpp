#pragma once
/// Axis-aligned boxes and the pairs of them that come near each other.

#include <span>
#include <utility>
#include <vector>

#include "core/vec.hpp"

namespace acinus::contact {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  void include(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Box grown(double margin) const {
    return {low - Vec3::Constant(margin), high + Vec3::Constant(margin)};
  }
  bool overlaps(const Box& o) const {
    return (low.array() <= o.high.array()).all() && (o.low.array() <= high.array()).all();
  }
  bool contains(const Vec3& p) const {
    return (low.array() <= p.array()).all() && (p.array() <= high.array()).all();
  }
};

inline Box sphere_box(const Vec3& center, double radius) {
  return {center - Vec3::Constant(radius), center + Vec3::Constant(radius)};
}

/// All pairs (i, j), i < j, of boxes closer than `margin` in every direction; ascending order.
/// Cost: linear in boxes and pairs (uniform grid of the largest box).
std::vector<std::pair<int, int>> find_pairs(std::span<const Box> boxes, double margin);

/// All pairs (i of a, j of b) closer than `margin`; ascending order.
std::vector<std::pair<int, int>> find_pairs_between(std::span<const Box> a, std::span<const Box> b,
                                                    double margin);

}  // namespace acinus::contact
