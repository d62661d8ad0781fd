#pragma once
/// Writers of label images for other programs.

#include <string>

#include "imaging/label_image.hpp"

namespace acinus::imaging {

/// Throws Error(kBadInput) unless the ending of a path is that of a supported format.
void check_image_file(const std::string& path);

/// Writes TIFF as ImageJ reads it (.tif), MetaImage (.mha) or NRRD (.nrrd), compressed, with the
/// size of a voxel in um, in the smallest of 8, 16 and 32 bits that holds all labels. The file
/// appears whole or not at all. Throws as check_image_file, and Error(kFileError) when the disk
/// refuses.
void write_image(const std::string& path, const LabelImage& image);

}  // namespace acinus::imaging
