#pragma once
/// Vessels cut into pieces, for triangles to be small only where a vessel is thin or passes another
/// closely.

#include <vector>

#include "core/mesh/network.hpp"

namespace acinus::implicit {

struct VesselPieces {
  mesh::Network network;   ///< the same vessels: a cut segment has further nodes along it
  std::vector<int> whole;  ///< [piece] the segment that it is of
  /// [piece] um, longest edge of the tetrahedra that cut it: the one wanted where it is thinnest,
  /// less where the vessel passes another that it shares no node with, with nothing but free space
  /// between, so that no edge reaches from one to the other; at least a tenth of the one wanted.
  std::vector<double> size;
  int overlapping = 0;  ///< pairs of segments that share no node and whose walls cross
};

/// @param of_radius  the edge wanted over the radius
VesselPieces cut_vessels(const mesh::Network& network, double of_radius);

}  // namespace acinus::implicit
