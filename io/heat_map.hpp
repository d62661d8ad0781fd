#pragma once
/// Heat maps as SVG files: a grid of fields with a colour and a text each.

#include <optional>
#include <string>
#include <vector>

namespace acinus::io {

struct HeatField {
  std::optional<double> share;    ///< 0 to 1, sets the colour; empty: unknown, hatched
  std::vector<std::string> text;  ///< lines in the field
};

struct HeatMap {
  std::string title, x_label, y_label;
  std::string scale_label;                    ///< of the colour scale
  std::vector<std::string> column, row;       ///< labels; rows from below
  std::vector<std::vector<HeatField>> field;  ///< [row][column]
};

/// Heat map as SVG text; width and height follow from its fields.
std::string draw_heat_map(const HeatMap& map);

/// Writes draw_heat_map(map).   @throws Error(kFileError)
void write_heat_map(const std::string& file, const HeatMap& map);

}  // namespace acinus::io
