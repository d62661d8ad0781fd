#pragma once
/// The zoom follows the tissue: cells that enter its regions become deformable, cells that leave
/// them become spheres.

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
  /// The process was asked to stop meanwhile: nothing has changed. To be called again before the
  /// next step.
  bool interrupted = false;
};

/// Looks at the regions if the last step crossed the time grid of the zoom. A sphere within a
/// region becomes deformable, a deformable cell farther than the margin from all regions a sphere;
/// at most ZoomParams::at_once of both at a look, those deepest inside and farthest outside first.
/// Cells that dissolve, spheres that come apart from their sister, daughters in mitosis and cells
/// that changed less than ZoomParams::stay ago stay what they are. New meshes settle among their
/// neighbours; forces that a pair exerted and does not any more fade (pair_forces.hpp). The
/// workspace is sized anew when a cell changed.
ZoomReport update_zoom(World& world, Workspace& work);

/// Time until the zoom is looked at again, s; infinite if it does not move.
double time_to_zoom_event(const World& world);

}  // namespace acinus::coupling
