#pragma once
/// Frames of the run file.

#include <vector>

#include "coupling/measure/contact_list.hpp"
#include "geometry/surface.hpp"
#include "io/frame_source.hpp"
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

/// Source of a frame; its contacts have no rows. Its points are collective: other processes call
/// send_points(). Refers to all that it is made of.
/// @param boundary  of draw_boundary()
/// @pre take_snapshot() of the same moment
io::FrameSource make_frame_source(const coupling::World& world, const coupling::Workspace& work,
                                  const Snapshot& snapshot, const geometry::Surface& boundary);
/// Takes part in reading the points of the root's source. Collective.
void send_points(const coupling::World& world, const coupling::Workspace& work);

/// Frame with all rows of the source.
io::Frame make_frame(const coupling::World& world, const coupling::Workspace& work,
                     const Snapshot& snapshot, const geometry::Surface& boundary);

}  // namespace acinus::runs
