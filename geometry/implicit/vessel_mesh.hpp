#pragma once
/// One closed surface round a network of vessels.

#include <cstddef>
#include <string>

#include "geometry/euler.hpp"
#include "geometry/network.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

struct VesselMeshOptions {
  double fineness = 0.4;  ///< edge length over the radius of the vessel
  double edge = 0;        ///< um, the same for all triangles; 0: by the radius of each vessel
  double rounding = 0.1;  ///< as VesselField
  int attempts = 3;       ///< ever finer, until the surface has the parts and loops of the network
};

struct VesselMesh {
  geometry::Surface surface;  ///< closed, a manifold, without self-intersection
  double fineness = 0;        ///< of the last attempt
  bool remeshed = false;      ///< true if remeshed to the given edge
  int overlapping = 0;        ///< pairs of segments that share no node and whose walls cross
  geometry::Connectivity found, expected;
  bool is_as_expected() const { return found == expected; }
};

/// Meshes the wall of a network. Triangles are smaller where walls face each other across a narrow
/// gap, and everywhere, for a few attempts, where parts or loops are wrong: is_as_expected has
/// the result. Overlapping walls never give the expected one. Remeshing that makes the surface
/// cross itself is undone. Throws Error if a radius is not above 0, the network has no segment, or
/// there would be too many triangles.
VesselMesh make_vessel_mesh(const geometry::Network& network, const VesselMeshOptions& options);

/// Message "the network has 1 part and 2 loops, the surface 1 and 3: ..." with the likely cause.
std::string describe_connectivity(const VesselMesh& mesh);

}  // namespace acinus::geometry
