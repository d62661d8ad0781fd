#pragma once
/// Detection of overlaps that contact cannot resolve.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/measure/audit.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Additional overlap of a surface between contact points, as a share of the mean edge length.
inline constexpr double kOverlapBetweenPoints = 0.25;

/// Largest overlap of a deformable cell with a cell, wall or vessel that contact can resolve, um:
/// max_depth of the contact search plus a share of a mesh edge, since a surface may lie deeper
/// between contact points.
double deepest_overlap(const coupling::World& world);

/// Unresolvable overlap of a frame, with its cells.
struct Excess {
  double depth_um = 0;  ///< overlap beyond the limit; 0: none, infinite: inverted cells
  std::string cause;
  std::vector<std::int64_t> cells;
};

/// Worst of: an inverted cell; an overlap of deformable cells beyond deepest_overlap(); a nucleus
/// outside its cortex by more than half of max_depth; a sphere whose centre lies in a cell, another
/// sphere, a vessel, behind a wall or on the wrong side of a static mesh, where forces no longer
/// separate them.
/// Each process audits its own cells. Collective.   @pre observe() of the same moment
Excess find_excess(const coupling::AuditResult& audit, const coupling::World& world,
                   const coupling::Workspace& work);

}  // namespace acinus::runs
