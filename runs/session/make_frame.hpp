#pragma once
/// Frames of the run file, and the independent audit of their overlaps.

#include <array>
#include <optional>
#include <vector>

#include "coupling/measure/audit.hpp"
#include "coupling/measure/contact_list.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/surface.hpp"
#include "io/frame.hpp"
#include "runs/experiments/snapshot.hpp"

namespace acinus::runs {

/// Triangulates vessels and pipettes for display.
geometry::Surface draw_boundary(const contact::Boundary& boundary);

/// Appends two columns per substance to the table of cells: the mean concentration in each cell,
/// and its rate of exchange.
void add_concentrations(const coupling::World& world, const Snapshot& snapshot, io::Table& cells);

/// Columns of /contacts, with a row for each contact.
/// @param cells  that the contacts number
io::Table contact_table(const std::vector<coupling::CellContact>& contacts,
                        const std::vector<coupling::CellMeasure>& cells);

/// Fills the arrays of a frame; its contacts have no rows.
/// @param boundary  of draw_boundary()
/// @pre take_snapshot() of the same moment
io::Frame make_frame(const coupling::World& world, const coupling::Workspace& work,
                     const Snapshot& snapshot, const geometry::Surface& boundary);

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
