#pragma once
/// Vessels cut into pieces where they pass others closely, for triangles to be small there only.

#include <vector>

#include "core/mesh/network.hpp"

namespace acinus::implicit {

struct VesselPieces {
  mesh::Network network;  ///< the same vessels: a cut segment has further nodes along it
  /// [segment] um, longest edge of the tetrahedra that cut it: the one wanted, less where the
  /// vessel passes another that it shares no node with, with nothing but free space between, so
  /// that no edge reaches from one to the other; at least a tenth of the one wanted.
  std::vector<double> size;
  int overlapping = 0;  ///< pairs of segments that share no node and whose walls cross
};

/// @param size  [segment] um, the edge wanted
VesselPieces cut_vessels(const mesh::Network& network, const std::vector<double>& size);

}  // namespace acinus::implicit
