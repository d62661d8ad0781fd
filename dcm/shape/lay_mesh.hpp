#pragma once
/// Mesh of a cell laid over a closed surface.

#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

struct LaidMesh {
  std::vector<Vec3> node;  ///< [n_node] um
  bool inflated = false;   ///< inflated inside, as the surface is not star-shaped
  std::string fault;       ///< defect of the mesh; empty: none
};

/// Mesh of a cell spread evenly over a surface, with its volume to 1e-12: chords cut corners off,
/// so the nodes stand a little outside. Sound if no triangle is of a quality below 0.1 and the mesh
/// does not cross itself.
/// @param surface   closed, outward, with volume
/// @param rotation  initial rotation of the sphere mesh
LaidMesh lay_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                  const Mat3& rotation);

}  // namespace acinus::dcm
