#pragma once
/// Measures of one frame: made once, used by the run file, the audit and the experiments.

#include <vector>

#include "coupling/measure/measure.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Cells and interface forces at a time.
struct Snapshot {
  double time = 0;  ///< s since t = 0
  std::vector<coupling::CellMeasure> cells;
  std::vector<coupling::InterfaceForce> interface;
};
/// Measures of the world as it is; assembles its loads in `work`.
Snapshot take_snapshot(const coupling::World& world, coupling::Workspace& work);

}  // namespace acinus::runs
