#pragma once
/// Tapering vessels cut into pieces, so that triangles are small only where the vessel is thin.

#include <vector>

#include "geometry/network.hpp"

namespace acinus::geometry {

struct VesselPieces {
  geometry::Network network;  ///< same vessels: a cut segment has further nodes along it
  std::vector<int> whole;     ///< [piece] its segment
  std::vector<double> size;   ///< [piece] um, longest edge of the tetrahedra that cut it
};

/// Vessels cut into pieces. @param of_radius  edge length over the radius of a piece where it is
/// thinnest
VesselPieces cut_vessels(const geometry::Network& network, double of_radius);

}  // namespace acinus::geometry
