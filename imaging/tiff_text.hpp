#pragma once
/// Description of a TIFF stack: OME's XML, ImageJ's lines, tifffile's shape.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "imaging/scalar.hpp"

namespace acinus::imaging {

/// Order of the pages of a stack, and the sides of its voxels.
struct TiffText {
  bool is_ome = false, is_imagej = false;
  std::int64_t slices = 0, channels = 1, times = 1;  ///< slices 0: all pages
  std::string order = "CZT";                         ///< order of pages, the fastest axis first
  Vec3 step = Vec3::Zero();                          ///< in units of the description; 0: not stated
  Vec3 unit = Vec3::Zero();                          ///< um in such a unit, by axis; 0: not stated
  std::string step_fault;  ///< reason why the sizes cannot be used, as an unknown unit; empty: none
  std::int64_t images = 0;  ///< ImageJ, tifffile: expected number of pages; 0: not stated
  std::int64_t width = 0, height = 0;  ///< pixels of a page; 0: not stated
  std::optional<Scalar> type;          ///< number type, if stated
  /// OME's TiffData: page of each plane in the order of the description; kElsewhere, kNowhere.
  /// Empty: the planes follow each other.
  std::vector<std::int64_t> page_of_plane;
  static constexpr std::int64_t kNowhere = -1, kElsewhere = -2;

  std::int64_t planes() const { return slices * channels * times; }
  /// Number of a slice of a channel in the order of the description. Times count as channels: c +
  /// channels * t.
  std::int64_t plane(std::int64_t slice, std::int64_t channel) const;
};

/// Reads a description.
/// @param description  of the first page
/// Throws Error where sizes are no numbers, or planes are given twice.
TiffText read_tiff_text(const std::string& path, const std::string& description);

/// Reads OME's XML [OME-TIFF]; returns nothing for any other text. Throws as read_tiff_text.
std::optional<TiffText> read_ome_text(const std::string& path, const std::string& description);

}  // namespace acinus::imaging
