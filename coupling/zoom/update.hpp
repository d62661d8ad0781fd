#pragma once
/// Update of a zoom: cells that enter its regions become deformable, cells that leave them become
/// spheres.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/world/event_kind.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct ModelChange {
  EventKind kind{};  ///< kPromotion, kPromotionWaits, kDemotion or kSettlingFailed
  std::int64_t cell = 0;
  std::string message;
};

struct ZoomReport {
  std::vector<ModelChange> changes;
  /// True if the process was asked to stop: nothing has changed. Call again before the next step.
  bool interrupted = false;
};

/// Updates the zoom if the last step crossed its time grid. A sphere within a region becomes
/// deformable; a deformable cell farther than the margin from all regions becomes a sphere. At most
/// ZoomParams::at_once cells change in an update, deepest inside and farthest outside first. Cells
/// in lysis, young sister spheres, daughters in mitosis and cells that changed less than
/// ZoomParams::stay ago keep their model. New meshes settle among their neighbours; lost pair
/// forces fade (pair_forces.hpp). Sizes the workspace anew if a cell changed.
ZoomReport update_zoom(World& world, Workspace& work);

/// Time to the next update of the zoom, s; infinite if it does not move.
double time_to_zoom_event(const World& world);

}  // namespace acinus::coupling
