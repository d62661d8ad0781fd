#pragma once
/// One closed surface about a network of vessels.

#include <cstddef>

#include "core/mesh/euler.hpp"
#include "core/mesh/network.hpp"
#include "core/mesh/surface.hpp"

namespace acinus::implicit {

struct VesselMeshOptions {
  double fineness = 0.3;  ///< edges over the radius of the vessel
  double edge = 0;        ///< um, of all triangles alike; 0: each vessel its own
  double rounding = 0.1;  ///< VesselField
  std::size_t most_triangles = 20'000'000;
};

struct VesselMesh {
  mesh::Surface surface;  ///< closed, a manifold, without self-intersection
  double fineness = 0;    ///< in the end
  bool remeshed = false;  ///< to the edge asked for
  mesh::Connectivity found, expected;
  bool is_as_expected() const { return found == expected; }
};

/// Where vessels stay apart, or loops stay open, by less than the triangles tell, these are made
/// smaller, a few times: is_as_expected says whether that was enough. It cannot be where segments
/// overlap that share no node. Remeshing that makes the surface cross itself is given up.
/// Throws Error if a radius is not above 0, the network has no segment, or there would be too many
/// triangles.
VesselMesh make_vessel_mesh(const mesh::Network& network, const VesselMeshOptions& options);

}  // namespace acinus::implicit
