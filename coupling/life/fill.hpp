#pragma once
/// The sub-simulation of a division: a mesh fills a closed surface from inside.

#include <string>
#include <vector>

#include "coupling/world/world.hpp"
#include "geometry/surface.hpp"

namespace acinus::coupling {

struct Filling {
  bool ok = true;
  std::string cause;
  std::vector<Vec3> node;  ///< um
  int steps = 0;
};

/// Lets a cell of the given type and mesh, in a liquid that hardly resists, come to rest inside a
/// surface that stands still and does not stick. The reference volume is what the surface encloses,
/// and the cortex is at rest on as much area as the surface has, so that nothing draws the cell out
/// of corners. Starts from `node`; the volume grows in the course if that encloses less.
Filling fill(const World& world, int type, const geometry::Topology& topology,
             const std::vector<Vec3>& node, const geometry::Surface& envelope);

}  // namespace acinus::coupling
