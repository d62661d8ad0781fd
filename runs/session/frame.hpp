#pragma once
/// What a frame of the run file holds of a world, and what the audit sees of it.

#include <optional>

#include "core/io/frame.hpp"
#include "core/mesh/audit_body.hpp"
#include "core/mesh/surface.hpp"
#include "coupling/measure/audit.hpp"
#include "runs/experiments/snapshot.hpp"

namespace acinus::runs {

/// Vessels and pipettes as triangles.
mesh::Surface draw_boundary(const contact::Boundary& boundary);

/// Fills the arrays of a frame. @pre take_snapshot of the same moment
/// @param boundary  of draw_boundary
io::Frame make_frame(const coupling::World& world, const coupling::Workspace& work,
                     const Snapshot& snapshot, const mesh::Surface& boundary);

/// The surface of the vessels as the audit sees it, as long as the boundary lives; none where cells
/// touch cones.
std::optional<mesh::AuditBody> prepare_vessel_surface(const contact::Boundary& boundary);

/// Independent check of overlaps at this moment. @pre take_snapshot of the same moment
/// @param vessel_surface  of prepare_vessel_surface; null: cells touch cones
coupling::AuditResult audit_world(const coupling::World& world, const coupling::Workspace& work,
                                  const Snapshot& snapshot,
                                  const mesh::AuditBody* vessel_surface = nullptr);

}  // namespace acinus::runs
