#pragma once
/// A cell's mesh laid over a closed surface.

#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

struct LaidMesh {
  std::vector<Vec3> node;  ///< [n_node] um
  bool inflated = false;   ///< blown up inside, where no point sees the surface whole
  std::string fault;       ///< what is wrong with it; empty: nothing
};

/// The nodes of a sphere mesh, spread evenly over a surface, with its volume to 1e-12: chords cut
/// corners off, so the nodes stand a little outside. Sound if no triangle is of a quality below 0.1
/// and the mesh does not cross itself.
/// @param surface   closed, outward, with volume
/// @param rotation  of the sphere mesh before
LaidMesh lay_mesh(const geometry::Topology& topology, const geometry::Surface& surface,
                  const Mat3& rotation);

}  // namespace acinus::dcm
