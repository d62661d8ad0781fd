#pragma once
/// Vessels as a function of space: negative inside the union of their round cones.

#include <span>

#include "core/mesh/network.hpp"
#include "core/vec.hpp"

namespace acinus::implicit {

/// Signed distance of the union of all segments, with the crease rounded where two of them share a
/// node. Segments that only pass each other are never joined by rounding, and two that go on
/// straight into each other have no crease. Outside and near the surface it is the distance, at
/// creases a little less; its slope is never above 1.
class VesselField {
 public:
  /// @param rounding  of a crease between segments that leave a node in one direction, as a share
  ///                  of the smaller radius there: the surface moves by at most a quarter of it
  VesselField(const mesh::Network& network, double rounding);

  /// um, where only some segments matter.
  double value(const Vec3& x, std::span<const int> segments) const;

  /// um, of one segment.
  double distance(const Vec3& x, int segment) const;

  /// um, the widest rounding.
  double widest_crease() const { return widest_crease_; }

 private:
  /// Rounding of the crease between two segments, um; 0 without a common node.
  double crease(int s, int t) const;

  const mesh::Network& network_;
  double rounding_ = 0, widest_crease_ = 0;
};

}  // namespace acinus::implicit
