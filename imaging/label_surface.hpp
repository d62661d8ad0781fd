#pragma once
/// The wall of one label as a closed surface.

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"
#include "imaging/pieces.hpp"

namespace acinus::imaging {

struct LabelSurface {
  geometry::Surface surface;  ///< closed, outward; um from the corner of the image
  double volume = 0;          ///< um^3, of the voxels: that of the surface and what is left out
  double left_out = 0;        ///< um^3, of parts that hang on by less than smoothing keeps
  long handles = 0;           ///< holes through it: 0 for what can be a cell
};

/// Where the distance from the voxels' wall, smoothed over `smoothing` voxels (standard deviation),
/// has the value at which the surface encloses their volume. What is outside the image counts as
/// outside the label, so that a label cut off by the border ends there.
/// @param piece      the voxels of its label in its box belong to it
/// @param edge       um, mean side of the triangles
/// Throws Error if nothing is left by that: a label of a few voxels.
LabelSurface make_label_surface(const LabelImage& image, const Piece& piece, double edge,
                                double smoothing);

}  // namespace acinus::imaging
