#pragma once
/// Background of a label image with a label other than 0.

#include "imaging/import_options.hpp"
#include "imaging/label_rows.hpp"

namespace acinus::imaging {

/// Sets the background label of the options to 0.
/// @throws Error if no voxel has it; without that option, if one label has most of the outermost
/// voxels on all six sides and so may be the background
void clear_background(const ImportOptions& options, LabelRows& image);

}  // namespace acinus::imaging
