#pragma once
/// Which overlaps contact can still mend, and which mean that a run has lost its way.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/measure/audit.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

/// How deep a deformable cell may stand in another, in a wall or in a vessel, um. Contact points
/// look max_depth deep; between points a surface may stand deeper by a part of a mesh edge.
double deepest_overlap(const coupling::World& world);

/// What is wrong with a frame, if anything.
struct Excess {
  double depth_um = 0;  ///< beyond the limit; 0: nothing is wrong, infinite: no overlap at all
  std::string cause;
  std::vector<std::int64_t> cells;
};

/// The worst of: a cell turned inside out; deformable cells deeper in something than
/// deepest_overlap; a nucleus outside its cortex by half of what contact looks for; a sphere whose
/// centre lies in a cell, another sphere, behind a wall, in a vessel or on the wrong side of a
/// static mesh, where forces no longer separate them.   @pre observe() of the same moment
Excess find_excess(const coupling::AuditResult& audit, const coupling::World& world,
                   const coupling::Workspace& work);

}  // namespace acinus::runs
