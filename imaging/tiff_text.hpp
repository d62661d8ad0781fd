#pragma once
/// Statements of the description of a TIFF stack: OME's XML, ImageJ's lines, tifffile's shape.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "imaging/scalar.hpp"

namespace acinus::imaging {

/// The order of the pages of a stack, and the sides of its voxels.
struct TiffText {
  bool is_ome = false, is_imagej = false;
  std::int64_t slices = 0, channels = 1, times = 1;  ///< slices 0: all pages
  std::string order = "CZT";                         ///< of pages, the fastest first
  Vec3 step = Vec3::Zero();  ///< in units of the description; 0 where it does not say
  Vec3 unit = Vec3::Zero();  ///< um in such a unit, by axis; 0: not said
  std::string step_fault;    ///< of sizes that cannot be used, as a unit that is not known
  std::int64_t images = 0;   ///< ImageJ, tifffile: pages there are meant to be; 0: not said
  std::int64_t width = 0, height = 0;  ///< pixels of a page; 0: not said
  std::optional<Scalar> type;          ///< of numbers, where it is said
  /// OME's TiffData: page of a plane in the order of the description; kElsewhere, kNowhere. Empty:
  /// in that order.
  std::vector<std::int64_t> page_of_plane;
  static constexpr std::int64_t kNowhere = -1, kElsewhere = -2;

  std::int64_t planes() const { return slices * channels * times; }
  /// Number of a slice of a channel in the order of the description; times count as channels:
  /// c + channels * t.
  std::int64_t plane(std::int64_t slice, std::int64_t channel) const;
};

/// @param description  of the first page
/// Throws Error where sizes are no numbers, or planes are given twice.
TiffText read_tiff_text(const std::string& path, const std::string& description);

/// Reads OME's XML [OME-TIFF]; returns nothing for any other text. Throws as read_tiff_text.
std::optional<TiffText> read_ome_text(const std::string& path, const std::string& description);

}  // namespace acinus::imaging
