#include "io/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/disk.hpp"
#include "io/svg_text.hpp"

namespace acinus::io {
namespace {

constexpr double kFieldWidth = 120, kFieldHeight = 54, kMapTop = 48, kMapBottom = 62, kScale = 110;

using Colour = std::array<double, 3>;

/// Colour of a share: white for 0, dark blue for 1.
Colour colour_of(double share) {
  constexpr Colour kNone{255, 255, 255}, kAll{33, 102, 172};
  Colour c{};
  const double s = std::clamp(share, 0.0, 1.0);
  for (std::size_t k = 0; k < 3; ++k) c[k] = kNone[k] + s * (kAll[k] - kNone[k]);
  return c;
}

std::string rgb(const Colour& c) {
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", c[0], c[1], c[2]);
}

std::string draw_field(const HeatField& field, double x, double y) {
  const std::string fill = field.share ? rgb(colour_of(*field.share)) : "url(#unknown)";
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\" "
      "stroke=\"#888\"/>\n",
      x, y, kFieldWidth, kFieldHeight, fill);
  const char* ink = field.share && *field.share > 0.6 ? " fill=\"white\"" : "";
  const double lines = static_cast<double>(field.text.size());
  double at = y + kFieldHeight / 2 - 7.5 * (lines - 1) + 4;
  for (const std::string& line : field.text) {
    out += svg_text(x + kFieldWidth / 2, at, "middle", line, ink);
    at += 15;
  }
  return out;
}

std::string draw_scale(double x, double top, double bottom, const std::string& label) {
  constexpr int kSteps = 20;
  constexpr double kWidth = 14;
  const double step = (bottom - top) / kSteps;
  std::string out;
  for (int k = 0; k < kSteps; ++k)
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
        bottom - (k + 1) * step, kWidth, step + 0.3, rgb(colour_of((k + 0.5) / kSteps)));
  out += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#888\"/>\n",
      x, top, kWidth, bottom - top);
  for (const double v : {0.0, 0.5, 1.0})
    out += svg_text(x + kWidth + 6, bottom - v * (bottom - top) + 4, "start",
                    fmt::format("{:.0f} %", 100 * v));
  const double middle = (top + bottom) / 2, at = x + kWidth + 54;
  return out + svg_text(at, middle, "middle", label,
                        fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at, middle));
}

/// Width of the left margin: the longest row label and the label of the axis.
double left_of(const HeatMap& map) {
  std::size_t longest = 0;
  for (const std::string& row : map.row) longest = std::max(longest, row.size());
  return 46 + 6.8 * static_cast<double>(longest);
}

}  // namespace

std::string draw_heat_map(const HeatMap& map) {
  const double left = left_of(map), n_column = static_cast<double>(map.column.size()),
               n_row = static_cast<double>(map.row.size());
  const double right = left + n_column * kFieldWidth, bottom = kMapTop + n_row * kFieldHeight;
  const double width = std::max(right + kScale, 9.0 * static_cast<double>(map.title.size()));
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<defs><pattern id=\"unknown\" width=\"6\" height=\"6\" "
      "patternUnits=\"userSpaceOnUse\"><rect width=\"6\" height=\"6\" fill=\"#eee\"/>"
      "<path d=\"M0 6L6 0\" stroke=\"#bbb\"/></pattern></defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, bottom + kMapBottom);
  out += svg_text(left, 26, "start", map.title, " font-size=\"15\"");
  for (std::size_t r = 0; r < map.row.size(); ++r) {
    const double y = bottom - static_cast<double>(r + 1) * kFieldHeight;
    out += svg_text(left - 8, y + kFieldHeight / 2 + 4, "end", map.row[r]);
    for (std::size_t c = 0; c < map.column.size(); ++c)
      out += draw_field(map.field[r][c], left + static_cast<double>(c) * kFieldWidth, y);
  }
  for (std::size_t c = 0; c < map.column.size(); ++c)
    out += svg_text(left + (static_cast<double>(c) + 0.5) * kFieldWidth, bottom + 18, "middle",
                    map.column[c]);
  out += svg_text((left + right) / 2, bottom + 44, "middle", map.x_label);
  const double middle = (kMapTop + bottom) / 2;
  out += svg_text(18, middle, "middle", map.y_label,
                  fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
  out += draw_scale(right + 18, kMapTop, bottom, map.scale_label);
  return out + "</svg>\n";
}

void write_heat_map(const std::string& file, const HeatMap& map) {
  write_text_file(file, draw_heat_map(map));
}

}  // namespace acinus::io
