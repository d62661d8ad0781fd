#pragma once
/// Regions of tissue: parts of space, neighbourhoods of moving objects, or cells under pressure.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

enum class RegionKind {
  kNone = -1,
  kSphere,
  kBox,
  kHalfSpace,
  kAxisDistance,
  kAll,
  // Regions that move with the tissue; for the zoom only.
  kFront,     ///< near the edge of the lesion
  kCells,     ///< near listed cells
  kVessel,    ///< near vessels
  kPressure,  ///< cells under contact pressure
};

/// Region of tissue; the members in use depend on `kind`.
struct Region {
  RegionKind kind = RegionKind::kNone;
  Vec3 center = Vec3::Zero();                    ///< sphere; um
  double radius = 0;                             ///< sphere; um
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box; um
  Vec3 point = Vec3::Zero(),
       normal = Vec3::UnitZ();  ///< half_space: (x - point).normal <= 0 is inside
  /// axis_distance: from the vein axis; front, cells and vessel: max_distance from the followed
  /// object, um
  double min_distance = 0, max_distance = 0;
  std::vector<std::int64_t> cells;  ///< cells: lineages
  bool offspring = true;            ///< cells: true: descendants are followed as well
  double above = 0, below = 0;      ///< pressure: kPa, thresholds of entry and exit
};

inline bool moves(RegionKind kind) { return kind > RegionKind::kAll; }

/// Distance of a point outside a part of space, um; 0 and less inside.
/// @param axis_point  the vein axis is vertical through it      @pre the region does not move
inline double distance_outside(const Region& r, const Vec3& axis_point, const Vec3& x) {
  switch (r.kind) {
    case RegionKind::kSphere:
      return (x - r.center).norm() - r.radius;
    case RegionKind::kBox:
      return std::max((r.low - x).maxCoeff(), (x - r.high).maxCoeff());
    case RegionKind::kHalfSpace:
      return (x - r.point).dot(r.normal.normalized());
    case RegionKind::kAxisDistance: {
      const double distance = (x - axis_point).head<2>().norm();
      return std::max(r.min_distance - distance, distance - r.max_distance);
    }
    default:
      return -1;
  }
}

/// True if a point lies in a part of space.
inline bool in_region(const Region& r, const Vec3& axis_point, const Vec3& x) {
  return distance_outside(r, axis_point, x) <= 0;
}

}  // namespace acinus::coupling
