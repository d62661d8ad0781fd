#pragma once
/// Where the walls of two vessels face each other across a narrow gap.

#include <vector>

#include "geometry/implicit/shape.hpp"
#include "geometry/network.hpp"

namespace acinus::geometry {

struct VesselGaps {
  /// On one of the two walls, with tetrahedra that do not reach across the gap; of segments that
  /// share a node the gap begins where the rounding of the crease ends.
  std::vector<FineBall> fine;
  int overlapping = 0;  ///< pairs of segments that share no node and whose walls cross
};

/// Gaps that tetrahedra of the usual size would reach across. Beside a gap of less than 1.5 % of
/// that size they still may.
/// @param rounding   VesselField
/// @param of_radius  longest edge of the tetrahedra elsewhere over the radius
VesselGaps find_narrow_gaps(const geometry::Network& network, double rounding, double of_radius);

}  // namespace acinus::geometry
