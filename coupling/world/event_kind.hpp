#pragma once
/// Kinds of events between two steps, with their names in run files.

#include <cstdint>

namespace acinus::coupling {

enum class EventKind : std::uint8_t {
  kDivision,        ///< cells: mother, daughter, daughter
  kDivisionWaits,   ///< no plane divides the cell cleanly
  kDeath,           ///< a cell is removed
  kDeathEarly,      ///< a dissolving cell is removed before it has shrunk
  kLysis,           ///< a cell begins to dissolve
  kRemeshed,        ///< a degenerate mesh is replaced
  kMeshDegenerate,  ///< a degenerate mesh stays
  kSettlingFailed,  ///< new meshes did not settle among their neighbours
  kPromotion,       ///< a sphere becomes deformable
  kPromotionWaits,  ///< it finds no shape
  kDemotion         ///< a deformable cell becomes a sphere
};

/// Name in run files and messages.
constexpr const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::kDivision:
      return "division";
    case EventKind::kDivisionWaits:
      return "division_waits";
    case EventKind::kDeath:
      return "death";
    case EventKind::kDeathEarly:
      return "death_early";
    case EventKind::kLysis:
      return "lysis";
    case EventKind::kRemeshed:
      return "remeshed";
    case EventKind::kMeshDegenerate:
      return "mesh_degenerate";
    case EventKind::kSettlingFailed:
      return "settling_failed";
    case EventKind::kPromotion:
      return "promotion";
    case EventKind::kPromotionWaits:
      return "promotion_waits";
    case EventKind::kDemotion:
      return "demotion";
  }
  return "";
}

}  // namespace acinus::coupling
