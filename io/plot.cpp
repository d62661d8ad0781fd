#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/disk.hpp"
#include "io/svg_text.hpp"

namespace acinus::io {
namespace {

constexpr double kWidth = 720, kHeight = 480;
constexpr double kPlotLeft = 80, kPlotRight = 190, kPlotTop = 40, kPlotBottom = 60;
constexpr double kFontSize = 12;

/// Colours that are distinct in print and for the colour blind.
constexpr std::array<const char*, 8> kColor{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                            "#e69f00", "#56b4e9", "#000000", "#999999"};

/// Multiples of 1, 2 or 5 times a power of ten from low to high, some six.
std::vector<double> steps(double low, double high) {
  const double rough = (high - low) / 6, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = rough / decade < 1.5   ? decade
                      : rough / decade < 3.5 ? 2 * decade
                                             : 5 * decade;
  std::vector<double> out;
  for (double t = std::ceil(low / step) * step; t <= high + 1e-9 * step; t += step)
    out.push_back(std::abs(t) < 1e-9 * step ? 0 : t);
  return out;
}

/// Width of a text of the usual size, as most browsers draw it.
double width_of_text(std::size_t characters) { return 6.6 * static_cast<double>(characters); }

/// Axis: maps values to positions on the page.
struct Axis {
  bool log = false;
  double low = 1e300, high = -1e300;  ///< range of the value, or of its decimal logarithm

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
  /// Round values within the axis, as places on it: steps of 1, 2 or 5, or decades.
  std::vector<double> ticks() const {
    constexpr double kLinear = 1, kParts = 2.5;  // most decades with steps; with 1, 2 and 5 of each
    if (log && high - low < kLinear) {
      std::vector<double> out;
      for (const double t : steps(std::pow(10, low), std::pow(10, high)))
        if (t > 0) out.push_back(std::log10(t));
      return out;
    }
    if (!log) return steps(low, high);
    std::vector<double> out;
    const bool parts = high - low < kParts;
    const double decades = std::ceil((high - low) / 8);
    for (double t = std::floor(low / decades) * decades; t <= high; t += decades)
      for (const double factor : {1.0, 2.0, 5.0})
        if (const double at = t + std::log10(factor);
            at >= low && at <= high && (parts || factor == 1))
          out.push_back(at);
    return out;
  }
  std::string label(double tick) const {
    return log ? fmt::format("{:.3g}", std::pow(10, tick)) : fmt::format("{:.4g}", tick);
  }
};

/// Plotting area with its axes.
struct Page {
  Axis x, y;
  double left = kPlotLeft;
  double right = kWidth - kPlotRight, bottom = kHeight - kPlotBottom;

  std::optional<std::pair<double, double>> place(double px, double py) const {
    const auto sx = x.scaled(px), sy = y.scaled(py);
    if (!sx || !sy) return std::nullopt;
    return std::pair{x.place(*sx, left, right), y.place(*sy, bottom, kPlotTop)};
  }
};

/// Bands as polygons, one for each run of neighbouring points that can be drawn, so that gaps stay
/// open.
std::string draw_band(const Page& page, const PlotLine& line, const char* color) {
  std::string out, there, back;
  const auto close = [&] {
    if (!there.empty() && line.joined)
      out += fmt::format("<path d=\"{}{}Z\" fill=\"{}\" fill-opacity=\"0.18\"/>\n", there, back,
                         color);
    there.clear();
    back.clear();
  };
  for (std::size_t k = 0; k < std::min(line.band.size(), line.point.size()); ++k) {
    const auto low = page.place(line.point[k].first, line.band[k].first),
               high = page.place(line.point[k].first, line.band[k].second);
    if (!low || !high) {
      close();
      continue;
    }
    if (!line.joined)
      out += fmt::format("<path d=\"M{:.1f} {:.1f} V{:.1f}\" stroke=\"{}\"/>\n", low->first,
                         low->second, high->second, color);
    there += fmt::format("{}{:.1f} {:.1f} ", there.empty() ? "M" : "L", high->first, high->second);
    back = fmt::format("L{:.1f} {:.1f} ", low->first, low->second) + back;
  }
  close();
  return out;
}

std::string draw_line(const Page& page, const PlotLine& line, const char* color, const char* dash) {
  std::string path, marks;
  for (const auto& [px, py] : line.point) {
    const auto at = page.place(px, py);
    if (!at) continue;
    path += fmt::format("{}{:.1f} {:.1f} ", path.empty() ? "M" : "L", at->first, at->second);
    if (line.marks)
      marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", at->first,
                           at->second, color);
  }
  if (line.joined && !path.empty())
    path = fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n",
                       path, color, dash);
  else
    path.clear();
  return path + marks;
}

/// Attribute for a text that is longer than the room for it.
std::string fit_text(const std::string& text, double room) {
  const double needed = width_of_text(text.size());
  return needed <= room ? "" : fmt::format(" font-size=\"{:.1f}\"", kFontSize * room / needed);
}

std::string draw_axes(const Page& page, const Plot& plot) {
  std::string out;
  const double left = page.left, right = page.right, bottom = page.bottom;
  for (double t : page.x.ticks()) {
    const double at = page.x.place(t, left, right);
    out += fmt::format("<path d=\"M{0:.1f} {1} V{2}\" stroke=\"#ddd\"/>\n", at, kPlotTop, bottom);
    out += svg_text(at, bottom + 18, "middle", page.x.label(t));
  }
  for (double t : page.y.ticks()) {
    const double at = page.y.place(t, bottom, kPlotTop);
    out += fmt::format("<path d=\"M{0} {1:.1f} H{2}\" stroke=\"#ddd\"/>\n", left, at, right);
    out += svg_text(left - 6, at + 4, "end", page.y.label(t));
  }
  out += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"black\"/>\n", left,
      kPlotTop, right - left, bottom - kPlotTop);
  out += svg_text((left + right) / 2, kHeight - 16, "middle", plot.x_label,
                  fit_text(plot.x_label, right - left));
  return out +
         svg_text(20, (kPlotTop + bottom) / 2, "middle", plot.y_label,
                  fmt::format(" transform=\"rotate(-90 20 {:.1f})\"{}", (kPlotTop + bottom) / 2,
                              fit_text(plot.y_label, bottom - kPlotTop)));
}

/// Width of the legend for the longest name, in whole steps so that most plots are equally wide.
double legend_width(const Plot& plot) {
  std::size_t longest = 0;
  for (const PlotLine& line : plot.line) longest = std::max(longest, line.name.size());
  const double needed = 48 + width_of_text(longest);
  return std::min(std::max(kPlotRight, 60 * std::ceil(needed / 60)), 550.0);
}

/// Extends the axes of a page to all points and bands of a plot.
void include_all(const Plot& plot, Page& page) {
  const auto include = [&](double px, double py) {
    const auto sx = page.x.scaled(px), sy = page.y.scaled(py);
    if (!sx || !sy) return;
    page.x.include(*sx);
    page.y.include(*sy);
  };
  for (const PlotLine& line : plot.line) {
    for (const auto& [px, py] : line.point) include(px, py);
    for (std::size_t k = 0; k < std::min(line.band.size(), line.point.size()); ++k) {
      include(line.point[k].first, line.band[k].first);
      include(line.point[k].first, line.band[k].second);
    }
  }
}

double width_of(const Plot& plot, const Page& page) {
  constexpr double kMargin = 16;
  return page.right + (plot.legend ? legend_width(plot) : kMargin);
}

double height_of(const Plot& plot) {
  return std::max(kHeight, kPlotTop + 14 + 18 * static_cast<double>(plot.line.size()));
}

std::string legend_entry(const Page& page, const PlotLine& line, std::size_t k, const char* color,
                         const char* dash) {
  const double at = kPlotTop + 14 + 18 * static_cast<double>(k);
  std::string out;
  if (line.joined)
    out = fmt::format("<path d=\"M{:.1f} {:.1f} h22\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                      page.right + 10, at - 4, color, dash);
  else
    out = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"{}\"/>\n",
                      page.right + 18, at - 7, color);
  return out + svg_text(page.right + 38, at, "start", line.name);
}

/// Draws the plot on a page whose axes include its points.
std::string draw(const Plot& plot, Page page) {
  const double middle = (page.left + page.right) / 2;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"{2}\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      width_of(plot, page), height_of(plot), kFontSize);
  out += svg_text(middle, 24, "middle", plot.title, " font-size=\"15\"");
  if (page.x.low > page.x.high) {
    out += svg_text(middle, kHeight / 2, "middle", "no points");
    return out + "</svg>\n";
  }
  page.x.widen();
  page.y.widen();
  out += draw_axes(page, plot);
  const auto color_of = [](std::size_t k) { return kColor[k % kColor.size()]; };
  for (std::size_t k = 0; k < plot.line.size(); ++k)  // bands below all lines
    out += draw_band(page, plot.line[k], color_of(k));
  for (std::size_t k = 0; k < plot.line.size(); ++k) {
    // more lines than colours: the later rounds are dashed
    const char* dash = k < kColor.size() ? "" : " stroke-dasharray=\"5 3\"";
    out += draw_line(page, plot.line[k], color_of(k), dash);
    if (plot.legend) out += legend_entry(page, plot.line[k], k, color_of(k), dash);
  }
  return out + "</svg>\n";
}

}  // namespace

namespace {

/// Makes room for the numbers of the y axis beside its label.
void fit_left(Page& page) {
  constexpr double kBeside = 38;  // the label, and gaps
  if (page.x.low > page.x.high) return;
  Axis y = page.y;
  y.widen();
  std::size_t longest = 0;
  for (const double t : y.ticks()) longest = std::max(longest, y.label(t).size());
  const double left = std::max(kPlotLeft, kBeside + width_of_text(longest));
  page.right += left - page.left;
  page.left = left;
}

/// Page of one plot, with axes over all points and bands.
Page page_of(const Plot& plot) {
  Page page{{plot.log_x}, {plot.log_y}};
  include_all(plot, page);
  fit_left(page);
  return page;
}

/// Drawing as a nested element of another one, at a position.
std::string at_place(std::string drawing, double x, double y) {
  return drawing.insert(std::string("<svg ").size(), fmt::format("x=\"{}\" y=\"{}\" ", x, y));
}

std::string enclose(const std::string& drawings, double width, double height) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
             "viewBox=\"0 0 {0} {1}\">\n",
             width, height) +
         drawings + "</svg>\n";
}

}  // namespace

std::string draw_plot(const Plot& plot) { return draw(plot, page_of(plot)); }

std::string draw_grid(const std::vector<Plot>& plots, std::size_t columns) {
  std::vector<Page> page;
  for (const Plot& plot : plots) page.push_back(page_of(plot));
  std::vector<double> left(columns + 1, 0);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t k = c; k < plots.size(); k += columns)
      left[c + 1] = std::max(left[c + 1], left[c] + width_of(plots[k], page[k]));
  std::string out;
  double top = 0;
  for (std::size_t row = 0; row < plots.size(); row += columns) {
    double height = 0;
    for (std::size_t k = row; k < std::min(row + columns, plots.size()); ++k) {
      out += at_place(draw(plots[k], page[k]), left[k - row], top);
      height = std::max(height, height_of(plots[k]));
    }
    top += height;
  }
  return enclose(out, *std::ranges::max_element(left), top);
}

std::string draw_panels(std::vector<Plot> plots) {
  Page all{{plots.front().log_x}, {plots.front().log_y}};
  for (const Plot& plot : plots) include_all(plot, all);
  double width = 0, height = 0;
  std::string out;
  for (std::size_t k = 0; k < plots.size(); ++k) {
    Plot& plot = plots[k];
    plot.legend = k + 1 == plots.size();
    Page page = page_of(plot);
    if (page.x.low <= page.x.high) page.y = all.y;
    fit_left(page);
    out += at_place(draw(plot, page), width, 0);
    width += width_of(plot, page);
    height = std::max(height, height_of(plot));
  }
  return enclose(out, width, height);
}

void write_plot(const std::string& file, const Plot& plot) {
  write_text_file(file, draw_plot(plot));
}

}  // namespace acinus::io
