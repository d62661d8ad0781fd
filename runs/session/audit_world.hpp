#pragma once
/// Independent audit of the overlaps of a frame.

#include <array>
#include <optional>
#include <vector>

#include "coupling/measure/audit.hpp"
#include "geometry/audit_body.hpp"
#include "runs/experiments/snapshot.hpp"

namespace acinus::runs {

/// Closed meshes of a boundary prepared for the audit; refers to the boundary.
struct StaticBodies {
  std::optional<geometry::AuditBody> vessel_surface;  ///< none: cells touch cones
  std::vector<coupling::AuditStaticMesh> mesh;
  std::vector<std::vector<std::array<int, 3>>> outward;  ///< [mesh][triangle], oriented outwards
};
StaticBodies prepare_static_bodies(const contact::Boundary& boundary);

/// Audits overlaps at the present positions with code independent of the contact search.
/// @param bodies  static bodies of the world's boundary
/// @pre take_snapshot() of the same moment
coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& work,
                                  const Snapshot& snapshot, const StaticBodies& bodies);

}  // namespace acinus::runs
