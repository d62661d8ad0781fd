#pragma once
/// What the description of a TIFF stack says about it: OME's XML, or ImageJ's lines.

#include <cstdint>
#include <string>

#include "core/vec.hpp"

namespace acinus::image {

/// The order of the pages of a stack, and the sides of its voxels.
struct TiffText {
  bool is_ome = false, is_imagej = false;
  std::int64_t slices = 0, channels = 1, times = 1;  ///< slices 0: all pages
  std::string order = "CZT";                         ///< of pages, the fastest first
  Vec3 step = Vec3::Zero();                          ///< um; 0 where it does not say
  double pixel_unit = 0;    ///< um in the unit of the file's resolution; 0: not said (ImageJ)
  std::int64_t images = 0;  ///< ImageJ: pages there are meant to be; 0: not said

  /// Page of a slice of a channel; times count as channels: c + channels * t.
  std::int64_t page(std::int64_t slice, std::int64_t channel) const;
};

/// @param description  of the first page
/// Throws Error where OME's sizes are no numbers, or a unit is not known.
TiffText read_tiff_text(const std::string& path, const std::string& description);

}  // namespace acinus::image
