#pragma once
/// A frame of the run file from a world, and the audit of its overlaps.

#include <array>
#include <optional>
#include <vector>

#include "coupling/measure/audit.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/surface.hpp"
#include "io/frame.hpp"
#include "runs/experiments/snapshot.hpp"

namespace acinus::runs {

/// Vessels and pipettes as triangles.
geometry::Surface draw_boundary(const contact::Boundary& boundary);

/// Fills the arrays of a frame. @pre take_snapshot of the same moment
/// @param boundary  of draw_boundary
io::Frame make_frame(const coupling::World& world, const coupling::Workspace& work,
                     const Snapshot& snapshot, const geometry::Surface& boundary);

/// The closed meshes of a boundary as the audit sees them, as long as the boundary lives.
struct StaticBodies {
  std::optional<geometry::AuditBody> vessel_surface;  ///< none: cells touch cones
  std::vector<coupling::AuditStatic> mesh;
  std::vector<std::vector<std::array<int, 3>>> outward;  ///< [mesh] its triangles
};
StaticBodies prepare_static_bodies(const contact::Boundary& boundary);

/// Independent check of overlaps at this moment. @pre take_snapshot of the same moment
/// @param bodies  of the world's boundary
coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& work,
                                  const Snapshot& snapshot, const StaticBodies& bodies);

}  // namespace acinus::runs
