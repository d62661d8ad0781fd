#pragma once
/// Narrow gaps between the walls of two vessels.

#include <vector>

#include "geometry/implicit/shape.hpp"
#include "geometry/network.hpp"

namespace acinus::geometry {

struct VesselGaps {
  /// Balls on one of the two walls, with tetrahedra that do not bridge the gap. For segments that
  /// share a node the gap begins where the rounding of the crease ends.
  std::vector<FineBall> fine;
  int overlapping = 0;  ///< pairs of segments that share no node and whose walls cross
};

/// Fine balls for gaps that tetrahedra of the usual size would bridge. Those beside a gap of less
/// than 1.5 % of that size still may.
/// @param rounding   as VesselField
/// @param of_radius  longest edge of the tetrahedra elsewhere over the radius
VesselGaps find_narrow_gaps(const geometry::Network& network, double rounding, double of_radius);

}  // namespace acinus::geometry
