#pragma once
/// Closed surface of one label.

#include "geometry/surface.hpp"
#include "imaging/label_rows.hpp"
#include "imaging/pieces.hpp"

namespace acinus::imaging {

struct LabelSurface {
  geometry::Surface surface;  ///< closed, outward; um from the corner of the image
  double volume = 0;          ///< um^3, of the voxels: that of the surface plus left_out
  double left_out = 0;  ///< um^3, of parts whose connection is thinner than the smoothing keeps
  long handles = 0;     ///< holes through it: 0 for a valid cell
};

/// Level surface of the distance from the voxels' wall, smoothed over `smoothing` voxels (standard
/// deviation), at the value that encloses their volume. Space outside the image counts as outside
/// the label, so that a label cut off by the border ends there.
/// @param piece      connected voxels of the label
/// @param edge       um, mean side of the triangles
/// Throws Error if nothing is left after smoothing: a label of a few voxels.
LabelSurface make_label_surface(const LabelRows& image, const Piece& piece, double edge,
                                double smoothing);

}  // namespace acinus::imaging
