#pragma once
/// Input of the experiments: a frame of a run.

#include "coupling/measure/audit.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"
#include "runs/experiments/snapshot.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// One written frame. The loads of this frame are assembled (take_snapshot).
struct ObservedFrame {
  const Scene& scene;
  const coupling::World& world;
  const coupling::Workspace& work;
  const Snapshot& snapshot;
  const coupling::AuditResult& audit;
};

}  // namespace acinus::runs
