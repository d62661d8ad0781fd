#include "runs/study/study_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

struct TimeAxis {
  const char* unit = "h";
  double seconds = 3600;
};

/// Unit of the time axis: days for long runs, minutes or seconds for short ones.
TimeAxis time_axis(const StudyPlan& plan, const StudyData& data,
                   const std::vector<std::size_t>& variants) {
  double end = 0;
  for (std::size_t k = 0; k < data.size(); ++k)
    if (std::ranges::find(variants, plan.runs[k].variant) != variants.end())
      end = std::max(end, data[k].until);
  if (end > 3 * 86400) return {"d", 86400};
  if (end < 120) return {"s", 1};
  if (end < 2 * 3600) return {"min", 60};
  return {};
}

struct Spread {
  double sum = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int n = 0;
  void add(double v) {
    sum += v;
    low = std::min(low, v);
    high = std::max(high, v);
    ++n;
  }
};

void add_point(io::PlotLine& line, double x, const Spread& s) {
  if (s.n == 0) return;
  line.point.emplace_back(x, s.sum / s.n);
  line.band.emplace_back(s.low, s.high);
}

/// Available curves of a variant.
struct CurvesOfVariant {
  std::vector<const TimeCurve*> curve;
  std::size_t n_run = 0;  ///< number of planned runs
  /// Suffix " (3 of 5 seeds)" if runs are missing, else empty.
  std::string missing() const {
    if (curve.size() == n_run) return {};
    return fmt::format(" ({} of {} seeds)", curve.size(), n_run);
  }
};

/// Curves of a variant without failed runs, whose further course is unknown.
/// @param to_the_end  only complete runs
CurvesOfVariant curves_of(const StudyPlan& plan, const StudyData& data, std::size_t variant,
                          const std::string& observable, bool to_the_end) {
  CurvesOfVariant out;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    if (plan.runs[k].variant != variant) continue;
    ++out.n_run;
    const RunState state = data[k].status.state;
    if (has_failed(state) || (to_the_end && state != RunState::kDone)) continue;
    const auto found = data[k].curve.find(observable);
    if (found != data[k].curve.end() && !found->second.time.empty())
      out.curve.push_back(&found->second);
  }
  return out;
}

/// Mean curve with its range, up to the end of the shortest curve: a mean over fewer runs would
/// jump.
io::PlotLine line_over_time(const std::vector<const TimeCurve*>& curves, double seconds) {
  std::set<double> times;
  for (const TimeCurve* c : curves) times.insert(c->time.begin(), c->time.end());
  io::PlotLine line;
  line.marks = times.size() <= 12;
  for (double t : times) {
    Spread s;
    for (const TimeCurve* c : curves)
      if (const auto v = value_at(*c, t)) s.add(*v);
    if (s.n == static_cast<int>(curves.size())) add_point(line, t / seconds, s);
  }
  return line;
}

/// Adds one line per base variant over a scene key, through the variants derived from it by sweeps.
void add_lines_over_key(const StudyPlan& plan, const StudyData& data, const StudyPlot& wanted,
                        const std::vector<std::size_t>& variants, io::Plot& plot) {
  std::map<std::string, std::vector<std::pair<double, Spread>>> lines;
  for (std::size_t v : variants) {
    std::optional<double> x;
    for (const StudyRun& run : plan.runs)
      if (run.variant == v) x = value_of_key(run.scene, wanted.over);
    if (!x) continue;
    Spread s;
    for (const TimeCurve* c : curves_of(plan, data, v, wanted.observable, !wanted.at).curve)
      if (const auto value = value_at(*c, wanted.at.value_or(c->time.back()))) s.add(*value);
    const std::string& name = plan.variants[v].name;
    const std::size_t sweep = name.rfind('/');
    const auto base = find_variants(plan.variants, name.substr(0, sweep));
    lines[base.empty() ? name : plan.variants[base.front()].title].emplace_back(*x, s);
  }
  for (auto& [title, points] : lines) {
    std::ranges::stable_sort(points, {}, [](const auto& p) { return p.first; });
    io::PlotLine line;
    line.name = title;
    for (const auto& [x, s] : points) add_point(line, x, s);
    plot.line.push_back(line);
  }
}

void add_reference(const StudyReference& r, const std::string& x_unit, double x_scale,
                   const std::string& y_unit, io::Plot& plot) {
  io::PlotLine line;
  line.name = r.name;
  line.joined = false;
  for (std::size_t k = 0; k < r.x.size(); ++k) {
    line.point.emplace_back(number_in(r.x[k], x_unit) / x_scale, number_in(r.y[k], y_unit));
    if (!r.low.empty())
      line.band.emplace_back(number_in(r.low[k], y_unit), number_in(r.high[k], y_unit));
  }
  plot.line.push_back(line);
}

/// Axis label of an observable: "lesion_radius_um" in "um" becomes "lesion_radius, um".
std::string with_unit(std::string name, const std::string& unit) {
  if (unit == "1") return name;
  std::string end = "_";
  for (char c : unit.starts_with("1/") ? "per_" + unit.substr(2) : unit)
    if (c != '^') end += c == '/' ? '_' : c;
  if (name.ends_with(end)) name.resize(name.size() - end.size());
  return name + ", " + unit;
}

}  // namespace

io::Plot make_plot(const StudyPlan& plan, const StudyData& data, const StudyPlot& wanted) {
  std::vector<std::size_t> variants;
  for (const std::string& name : wanted.variants)
    for (std::size_t v : find_variants(plan.variants, name)) variants.push_back(v);
  if (wanted.variants.empty())
    for (std::size_t v = 0; v < plan.variants.size(); ++v) variants.push_back(v);
  const std::string& y_unit = plan.units.at(wanted.observable);
  io::Plot plot;
  plot.title = wanted.title.empty() ? wanted.name : wanted.title;
  plot.y_label = wanted.y_label.empty() ? with_unit(wanted.observable, y_unit) : wanted.y_label;
  plot.log_y = wanted.log_y;
  const TimeAxis axis = time_axis(plan, data, variants);
  std::string x_unit = "s";
  double x_scale = axis.seconds;
  if (wanted.over.empty()) {
    plot.x_label = fmt::format("time, {}", axis.unit);
    for (std::size_t v : variants) {
      const CurvesOfVariant found = curves_of(plan, data, v, wanted.observable, false);
      io::PlotLine line = line_over_time(found.curve, axis.seconds);
      line.name = plan.variants[v].title + found.missing();
      if (!line.point.empty()) plot.line.push_back(line);
    }
  } else {
    x_unit = unit_of_key(wanted.over).value_or("1");
    x_scale = 1;
    plot.x_label = with_unit(wanted.over, x_unit);
    add_lines_over_key(plan, data, wanted, variants, plot);
  }
  if (!wanted.x_label.empty()) plot.x_label = wanted.x_label;
  for (const StudyReference& r : wanted.reference) add_reference(r, x_unit, x_scale, y_unit, plot);
  return plot;
}

namespace {

/// SVG text of a plot with further panels of the same variants beside it, titled by their
/// observables.
std::string draw_with_panels(const StudyPlan& plan, const StudyData& data,
                             const StudyPlot& wanted) {
  if (wanted.beside.empty()) return io::draw_plot(make_plot(plan, data, wanted));
  std::vector<io::Plot> panels{make_plot(plan, data, wanted)};
  for (const std::string& observable : wanted.beside) {
    StudyPlot panel = wanted;
    panel.observable = observable;
    panel.reference.clear();
    panel.y_label.clear();
    panels.push_back(make_plot(plan, data, panel));
    panels.back().title = panels.back().y_label;
  }
  return io::draw_panels(std::move(panels));
}

std::string draw_figure(const StudyPlan& plan, const StudyData& data, const StudyFigure& figure) {
  std::vector<io::Plot> plots;
  for (const std::string& name : figure.plots)
    plots.push_back(
        make_plot(plan, data, *std::ranges::find(plan.study.plots, name, &StudyPlot::name)));
  for (std::size_t k = 0; k < plots.size() && plots.size() <= 26; ++k)
    plots[k].title = fmt::format("{}: {}", static_cast<char>('a' + k), plots[k].title);
  return io::draw_grid(plots, figure.columns);
}

}  // namespace

std::vector<std::string> write_plots(const StudyPlan& plan, const StudyData& data,
                                     const std::string& root) {
  std::vector<StudyPlot> wanted = plan.study.plots;
  if (wanted.empty()) {
    std::set<std::string> names(plan.study.observables.begin(), plan.study.observables.end());
    if (names.empty())
      for (const RunData& d : data)
        for (const auto& [name, curve] : d.curve) names.insert(name);
    for (const std::string& name : names) {
      StudyPlot plot;
      plot.name = plot.observable = name;
      wanted.push_back(plot);
    }
  }
  std::error_code code;
  std::filesystem::create_directories(root + "/plots", code);
  check(!code, fmt::format("{}/plots: cannot be made: {}", root, code.message()), Exit::kFileError);
  std::vector<std::string> files;
  for (const StudyPlot& plot : wanted) {
    files.push_back(plot.name + ".svg");
    io::write_text_file(root + "/plots/" + files.back(), draw_with_panels(plan, data, plot));
  }
  for (const StudyFigure& figure : plan.study.figures) {
    files.push_back(figure.name + ".svg");
    io::write_text_file(root + "/plots/" + files.back(), draw_figure(plan, data, figure));
  }
  return files;
}

}  // namespace acinus::runs
