#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "io/disk.hpp"
#include "io/plot.hpp"
#include "runs/compare/compare.hpp"
#include "runs/scene/json_text.hpp"

namespace acinus::runs {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson number_text(double v) {
  return std::isfinite(v) ? OrderedJson(v) : OrderedJson(nullptr);
}

std::string show_number(double v) { return std::isnan(v) ? "-" : fmt::format("{:.5g}", v); }

std::string show_change(const Difference& d) {
  if (std::isinf(d.change())) return "undefined";  // the reference is 0
  return std::isnan(d.change()) ? "-" : fmt::format("{:+.1f} %", 100 * d.change());
}

std::string show_rms(const Difference& d) {
  if (std::isinf(d.rms())) return "undefined";
  if (std::isnan(d.rms())) return "-";
  return d.absolute ? fmt::format("{:.3g} {}", d.rms(), d.unit)
                    : fmt::format("{:.1f} %", 100 * d.rms());
}

const char* judged_column(const Difference& d) { return d.is_rms ? "rms" : "change"; }

std::string verdict(const Difference& d) {
  if (!d.tolerance) return "";
  return fmt::format("{} ({} at most {})",
                     !d.not_measured.empty() ? "NOT MEASURED"
                     : d.passes()            ? "within"
                                             : "BEYOND",
                     judged_column(d),
                     d.absolute ? fmt::format("{:g} {}", *d.tolerance, d.unit)
                                : fmt::format("{:g} %", 100 * *d.tolerance));
}

/// Distinct reasons for missing verdicts.
std::set<std::string> reasons_of(const Comparison& c) {
  std::set<std::string> reasons;
  for (const auto& run : c.difference)
    for (const Difference& d : run)
      if (d.tolerance && !d.not_measured.empty()) reasons.insert(d.not_measured);
  return reasons;
}

std::string show_friction(double friction) {
  return std::isnan(friction) ? "by the law" : fmt::format("{:.4g} N s/m^3", 1e9 * friction);
}

}  // namespace

std::string comparison_table(const Comparison& c) {
  std::string t = fmt::format("{} frames from {:.4g} h to {:.4g} h; reference: {}\n", c.frames,
                              c.from / 3600, c.to / 3600, c.runs[0]);
  for (std::size_t r = 0; r < c.runs.size(); ++r)
    for (const Drag& d : c.drag[r])
      t += fmt::format("drag in {}: {} {:.4g} nN s/um per free cell, {} between cells\n", c.runs[r],
                       name_of_choice(d.model), d.medium, show_friction(d.cell_friction));
  for (std::size_t r = 0; r < c.difference.size(); ++r) {
    t += fmt::format("\n{}\n  {:14} {:>12} {:>12} {:7} {:>10} {:>10}  {}\n", c.runs[r + 1],
                     "quantity", "reference", "this run", "unit", "change", "rms", "verdict");
    for (const Difference& d : c.difference[r])
      t += fmt::format("  {:14} {:>12} {:>12} {:7} {:>10} {:>10}  {}\n", d.name,
                       d.absolute ? "-" : show_number(d.reference),
                       d.absolute ? "-" : show_number(d.value), d.unit, show_change(d), show_rms(d),
                       verdict(d));
  }
  t += "\nchange: of the values shown, with its sign. rms: difference over time, of positions and "
       "cell_ quantities over cells.\n";
  const std::set<std::string> reasons = reasons_of(c);
  for (const std::string& why : reasons) t += "not measured: " + why + "\n";
  for (const std::string& note : c.notes)
    if (!reasons.contains(note)) t += "note: " + note + "\n";
  return t;
}

void write_comparison(const Comparison& c, const std::string& file) {
  OrderedJson j;
  j["runs"] = c.runs;
  j["from_s"] = c.from;
  j["to_s"] = c.to;
  j["frames"] = c.frames;
  j["passes"] = c.passes();
  j["notes"] = c.notes;
  j["drag"] = OrderedJson::array();
  for (std::size_t r = 0; r < c.runs.size(); ++r)
    for (const Drag& d : c.drag[r])
      j["drag"].push_back({{"run", c.runs[r]},
                           {"model", name_of_choice(d.model)},
                           {"medium_nN_s_per_um", d.medium},
                           {"cell_cell_N_s_per_m3", 1e9 * d.cell_friction}});
  j["differences"] = OrderedJson::array();
  for (std::size_t r = 0; r < c.difference.size(); ++r)
    for (const Difference& d : c.difference[r]) {
      OrderedJson row{{"run", c.runs[r + 1]},
                      {"quantity", d.name},
                      {"unit", d.unit},
                      {"reference", number_text(d.reference)},
                      {"value", number_text(d.value)},
                      {"difference", number_text(d.difference)},
                      {"absolute", d.absolute},
                      {"change", number_text(d.change())},
                      {"rms", number_text(d.rms())},
                      {"judged", judged_column(d)}};
      if (d.tolerance) {
        row["tolerance"] = *d.tolerance;
        row["passes"] = d.passes();
        if (!d.not_measured.empty()) row["not_measured"] = d.not_measured;
      }
      j["differences"].push_back(row);
    }
  j["traces"] = OrderedJson::object();
  const std::string stem = std::filesystem::path(file).replace_extension().string();
  for (const Trace& trace : c.trace) {
    OrderedJson values = OrderedJson::object();
    io::Plot plot{trace.name, "time, h", trace.name + ", " + trace.unit, false, false, {}};
    for (std::size_t r = 0; r < c.runs.size(); ++r) {
      values[c.runs[r]] = trace.value[r];
      io::PlotLine line{as_utf8(c.runs[r]), {}, false, true};
      for (std::size_t k = 0; k < trace.time.size(); ++k)
        line.point.emplace_back(trace.time[k] / 3600, trace.value[r][k]);
      plot.line.push_back(line);
    }
    j["traces"][trace.name] = {{"time_s", trace.time}, {"unit", trace.unit}, {"value", values}};
    io::write_plot(fmt::format("{}_{}.svg", stem, trace.name), plot);
  }
  io::write_text_file(file, j.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

}  // namespace acinus::runs
