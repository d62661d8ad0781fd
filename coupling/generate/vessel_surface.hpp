#pragma once
/// Triangulated vessels for files and pictures. Contacts use the segments.

#include <vector>

#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

struct VesselSurface {
  geometry::Surface surface;  ///< one closed tube a segment, overlapping at branch points
  std::vector<int> segment;   ///< [n_triangle] index of its segment
};

/// Makes ten-sided tubes with a ring at most every 6 um and round ends in two steps. The corners
/// lie on the wall of the vessel, so a tube has 94 % of the volume of its vessel. Segments of
/// length 0 become balls.
VesselSurface make_vessel_surface(const geometry::Network& network);

/// Volume of the segments, sum of pi L (ra^2 + ra rb + rb^2) / 3, um^3; overlap at branch points
/// counts twice.
double vessel_volume(const geometry::Network& network);

}  // namespace acinus::coupling
