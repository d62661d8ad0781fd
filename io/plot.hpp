#pragma once
/// Line plots as SVG files that open in any browser: no library, no fonts, one file each.

#include <string>
#include <utility>
#include <vector>

namespace acinus::io {

/// Line of a plot, in the order of its points.
struct PlotLine {
  std::string name;
  std::vector<std::pair<double, double>> point;
  bool marks = true;   ///< a mark at every point
  bool joined = true;  ///< line segments between the points
  /// Shaded band round the line: low and high, one pair per point; empty = none. For a line that is
  /// not joined these are error bars.
  std::vector<std::pair<double, double>> band = {};
};

struct Plot {
  std::string title, x_label, y_label;  ///< labels carry the unit
  bool log_x = false, log_y = false;    ///< logarithmic axes leave out points that are not positive
  std::vector<PlotLine> line;
  bool legend = true;
};

/// Plot as SVG text, 720 wide and 480 high, wider and higher where the legend needs it. Points that
/// are not finite are left out; a plot without points has a note instead.
std::string draw_plot(const Plot& plot);

/// Panels of the same lines side by side, with one range of y and one legend. @pre at least one
std::string draw_panels(std::vector<Plot> plots);

/// Plots in rows of `columns`, each with its own axes and legend. @pre columns > 0
std::string draw_grid(const std::vector<Plot>& plots, std::size_t columns);

/// Writes draw_plot(plot).   @throws Error(kFileError)
void write_plot(const std::string& file, const Plot& plot);

}  // namespace acinus::io
