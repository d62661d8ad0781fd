#pragma once
/// Sub-simulation of a division: a mesh fills a closed surface from inside.

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

/// Relaxes a cell of a type and mesh, in a medium of low friction, inside a fixed surface without
/// adhesion. The reference volume is that enclosed by the surface, and the rest area of the cortex
/// equals the area of the surface, so no tension draws the cell out of corners. Starts from `node`;
/// the volume grows in the course if that encloses less.
Filling fill(const World& world, int type, const geometry::Topology& topology,
             const std::vector<Vec3>& node, const geometry::Surface& envelope);

}  // namespace acinus::coupling
