#pragma once
/// Kinds of events between two steps, with their names in run files.

#include <cstdint>

namespace acinus::coupling {

enum class EventKind : std::uint8_t {
  kDivision,        ///< division; cells: mother, daughter, daughter
  kDivisionWaits,   ///< postponed division: no plane divides the cell cleanly
  kDeath,           ///< removal of a cell
  kDeathEarly,      ///< removal of a dissolving cell before it has shrunk
  kLysis,           ///< start of lysis
  kRemeshed,        ///< replacement of a degenerate mesh
  kMeshDegenerate,  ///< degenerate mesh that could not be repaired
  kSettlingFailed,  ///< failed settling of new meshes
  kPromotion,       ///< change of a sphere to a deformable cell
  kPromotionWaits,  ///< postponed promotion: no acceptable shape
  kDemotion         ///< change of a deformable cell to a sphere
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
