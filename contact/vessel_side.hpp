#pragma once
/// The side of a contact that a vessel is, where it moves.

#include "contact/boundary.hpp"
#include "solve/links.hpp"

namespace acinus::contact {

/// First row of the nodes of a network that moves; rows are those of the system. kAtRest: the
/// vessels have no unknowns.
inline constexpr std::size_t kAtRest = static_cast<std::size_t>(-1);

/// The place on the axis of a segment that a point is nearest to: its force acts there, along the
/// line to the point, and turns nothing.
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
