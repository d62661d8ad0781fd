#include "core/io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/io/disk.hpp"

namespace acinus::io {
namespace {

constexpr double kWidth = 720, kHeight = 480;
constexpr double kLeft = 80, kRight = 190, kTop = 40, kBottom = 60;

/// Colours that differ in print and for the colour blind.
constexpr std::array<const char*, 8> kColor{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                            "#e69f00", "#56b4e9", "#000000", "#999999"};

std::string escape(const std::string& text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// One axis: from values to places on the page.
struct Axis {
  bool log = false;
  double low = 1e300, high = -1e300;  ///< of the value, or of its decimal logarithm

  std::optional<double> scaled(double value) const {
    if (!std::isfinite(value) || (log && value <= 0)) return std::nullopt;
    return log ? std::log10(value) : value;
  }
  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  void widen() {
    const double room = high > low ? 0.05 * (high - low) : std::max(0.1, 0.1 * std::abs(high));
    low -= room;
    high += room;
  }
  double place(double v, double from, double to) const {
    return from + (v - low) / (high - low) * (to - from);
  }
  /// Round values within the axis: decades, or steps of 1, 2 or 5.
  std::vector<double> ticks() const {
    std::vector<double> out;
    double step = 1;
    if (!log || high - low < 1.5) {
      const double rough = (high - low) / 6, decade = std::pow(10, std::floor(std::log10(rough)));
      step = rough / decade < 1.5 ? decade : rough / decade < 3.5 ? 2 * decade : 5 * decade;
    } else if (high - low > 8) {
      step = std::ceil((high - low) / 8);
    }
    for (double t = std::ceil(low / step) * step; t <= high + 1e-9 * step; t += step)
      out.push_back(std::abs(t) < 1e-9 * step ? 0 : t);
    return out;
  }
  std::string label(double tick) const {
    return log ? fmt::format("{:.3g}", std::pow(10, tick)) : fmt::format("{:.4g}", tick);
  }
};

std::string text(double x, double y, const std::string& anchor, const std::string& words,
                 const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escape(words));
}

}  // namespace

std::string draw_plot(const Plot& plot) {
  Axis x{plot.log_x}, y{plot.log_y};
  for (const PlotLine& line : plot.line)
    for (const auto& [px, py] : line.point)
      if (const auto sx = x.scaled(px), sy = y.scaled(py); sx && sy) {
        x.include(*sx);
        y.include(*sy);
      }
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      kWidth, kHeight);
  out += text((kLeft + right) / 2, 24, "middle", plot.title, " font-size=\"15\"");
  if (x.low > x.high) {
    out += text((kLeft + right) / 2, kHeight / 2, "middle", "no points");
    return out + "</svg>\n";
  }
  x.widen();
  y.widen();
  for (double t : x.ticks()) {
    const double at = x.place(t, kLeft, right);
    out += fmt::format("<path d=\"M{0:.1f} {1} V{2}\" stroke=\"#ddd\"/>\n", at, kTop, bottom);
    out += text(at, bottom + 18, "middle", x.label(t));
  }
  for (double t : y.ticks()) {
    const double at = y.place(t, bottom, kTop);
    out += fmt::format("<path d=\"M{0} {1:.1f} H{2}\" stroke=\"#ddd\"/>\n", kLeft, at, right);
    out += text(kLeft - 6, at + 4, "end", y.label(t));
  }
  out += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n",
      kLeft, kTop, right - kLeft, bottom - kTop);
  out += text((kLeft + right) / 2, kHeight - 16, "middle", plot.x_label);
  out += text(20, (kTop + bottom) / 2, "middle", plot.y_label,
              fmt::format(" transform=\"rotate(-90 20 {:.1f})\"", (kTop + bottom) / 2));
  for (std::size_t k = 0; k < plot.line.size(); ++k) {
    const PlotLine& line = plot.line[k];
    const char* color = kColor[k % kColor.size()];
    // more lines than colours: the later rounds are dashed
    const char* dash = k < kColor.size() ? "" : " stroke-dasharray=\"5 3\"";
    std::string path, marks;
    for (const auto& [px, py] : line.point) {
      const auto sx = x.scaled(px), sy = y.scaled(py);
      if (!sx || !sy) continue;
      const double ax = x.place(*sx, kLeft, right), ay = y.place(*sy, bottom, kTop);
      path += fmt::format("{}{:.1f} {:.1f} ", path.empty() ? "M" : "L", ax, ay);
      if (line.marks)
        marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", ax, ay,
                             color);
    }
    if (line.joined && !path.empty())
      out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n",
                         path, color, dash);
    out += marks;
    const double at = kTop + 14 + 18 * static_cast<double>(k);
    out += fmt::format("<path d=\"M{:.1f} {:.1f} h22\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                       right + 10, at - 4, color, dash);
    out += text(right + 38, at, "start", line.name);
  }
  return out + "</svg>\n";
}

void write_plot(const std::string& file, const Plot& plot) {
  write_text_file(file, draw_plot(plot));
}

}  // namespace acinus::io
