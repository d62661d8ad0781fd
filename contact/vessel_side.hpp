#pragma once
/// Vessel side of a contact, for vessels that move.

#include "contact/boundary.hpp"
#include "solve/links.hpp"

namespace acinus::contact {

/// Value of `first_row` for vessels without unknowns. Otherwise it is the first row of the
/// network's nodes in the system.
inline constexpr std::size_t kAtRest = static_cast<std::size_t>(-1);

/// Point on the axis of a segment nearest to x, as a side of a link. The force acts there along the
/// line to x and exerts no torque.
inline solve::Side vessel_side(const Vessels& vessels, std::size_t first_row, int segment,
                               const Vec3& x) {
  if (first_row == kAtRest) return solve::Side::nowhere();
  const std::size_t s = segment;
  const auto point = [&](int end) {
    const std::size_t node = vessels.network.segment[s][static_cast<std::size_t>(end)];
    return static_cast<solve::Point>((first_row + node) * kLanes);
  };
  const auto t = static_cast<float>(gap_to_segment(vessels.network, segment, x).parameter);
  // The third weight is 0.
  return {{point(0), point(1), point(1)}, {1 - t, t}};
}

}  // namespace acinus::contact
