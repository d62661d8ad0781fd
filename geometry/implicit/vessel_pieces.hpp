#pragma once
/// Tapering vessels cut into pieces, for triangles to be small only where they are thin.

#include <vector>

#include "geometry/network.hpp"

namespace acinus::geometry {

struct VesselPieces {
  geometry::Network network;  ///< the same vessels: a cut segment has further nodes along it
  std::vector<int> whole;     ///< [piece] the segment that it is of
  std::vector<double> size;   ///< [piece] um, longest edge of the tetrahedra that cut it
};

/// @param of_radius  the edge wanted over the radius of a piece where it is thinnest
VesselPieces cut_vessels(const geometry::Network& network, double of_radius);

}  // namespace acinus::geometry
