#pragma once
/// Vessels as triangles, for files and pictures. Contacts use the segments, never this surface.

#include <vector>

#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

struct VesselSurface {
  geometry::Surface surface;  ///< one closed tube a segment, overlapping at branch points
  std::vector<int> segment;   ///< [n_triangle] index of the segment it draws
};

/// Ten-sided tubes with a ring at most every 6 um and round ends in two steps. The ring's corners
/// lie on the vessel's wall, so a tube holds 94 % of its vessel's volume. Segments of length zero
/// become balls.
VesselSurface make_vessel_surface(const geometry::Network& network);

/// Sum over segments of pi L (ra^2 + ra rb + rb^2) / 3, um^3; overlap at branch points counts
/// twice.
double vessel_volume(const geometry::Network& network);

}  // namespace acinus::coupling
