#pragma once
/// The background of a label image, where it is not 0.

#include "imaging/label_image.hpp"
#include "runs/images/import_options.hpp"

namespace acinus::runs {

/// Makes the label that the options name 0. Throws Error if no voxel has it; or if they name none,
/// and one label looks like a background: it has most of the outermost voxels on all six sides.
void clear_background(const ImportOptions& options, imaging::LabelImage& image);

}  // namespace acinus::runs
