#pragma once
/// Triangulated vessels for files and pictures. Contacts use the segments.

#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

/// Makes a closed tube of ten sides for each segment, with a ring at most every 6 um and round ends
/// in two steps. Tubes overlap at branch points. The corners lie on the wall of the vessel, so a
/// tube has 94 % of the volume of its vessel. Segments of length 0 become balls.
geometry::Surface make_vessel_surface(const geometry::Network& network);

}  // namespace acinus::coupling
