#pragma once
/// What a frame of the run file holds of a world, and what the audit sees of it.

#include <vector>

#include "core/io/frame.hpp"
#include "coupling/audit.hpp"
#include "coupling/generate/vessel_surface.hpp"
#include "coupling/measure.hpp"
#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::runs {

/// Everything about one moment: made once, used by the file, the audit and the experiments.
struct Snapshot {
  double time = 0;  ///< s since t = 0
  std::vector<coupling::CellMeasure> cells;
  coupling::NodeMeasure nodes;
  std::vector<coupling::InterfaceForce> interface;
};
Snapshot take_snapshot(const coupling::World& world, coupling::Workspace& work);

/// Fills the arrays of a frame. @pre take_snapshot of the same moment
io::Frame make_frame(const coupling::World& world, const coupling::Workspace& work,
                     const Snapshot& snapshot, const coupling::VesselSurface& vessels);

/// Independent check of overlaps at this moment. @pre take_snapshot of the same moment
coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& work,
                                  const Snapshot& snapshot);

}  // namespace acinus::runs
