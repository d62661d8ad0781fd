#pragma once
/// Statements about axes that programs write as JSON beside their images.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace acinus::imaging {

/// Names of axes, slowest first, in lower case, from vigra's axistags as ilastik writes them.
/// Nothing where the text has another form.
std::optional<std::vector<std::string>> read_axis_tags(const std::string& text);

/// Shape that tifffile writes as the description of the first page.
struct TiffShape {
  std::vector<std::int64_t> length;  ///< slowest axis first
  std::string axes;                  ///< a letter an axis, as "CZYX"; empty: not stated
};

/// Shape from such a description. Nothing where the text has another form.
std::optional<TiffShape> read_tiff_shape(const std::string& text);

}  // namespace acinus::imaging
