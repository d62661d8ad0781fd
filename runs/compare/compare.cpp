#include "runs/compare/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "core/sphere.hpp"
#include "core/vec.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/compare/compared_runs.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

/// True for keys that may differ between runs of the same scene: the models of cells, the constants
/// of spheres, and settings of the computation.
bool may_differ(const std::string& pointer) {
  const Entry* key = find_innermost_entry(pointer);
  return key != nullptr && !key->compared;
}

double mean(const CellRecords& cells, double CellRecord::*what) {
  double sum = 0;
  for (const auto& [id, c] : cells) sum += c.*what;
  return cells.empty() ? 0 : sum / static_cast<double>(cells.size());
}

/// Ball about the mean position of the reference's cells that contains half of them.
struct TissueCenter {
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double border = 0;  ///< mean radius of the cells, um
};
TissueCenter middle_of(const CellRecords& cells) {
  TissueCenter m;
  for (const auto& [id, c] : cells) m.center += c.center / static_cast<double>(cells.size());
  std::vector<double> r;
  for (const auto& [id, c] : cells) r.push_back((c.center - m.center).norm());
  std::ranges::sort(r);
  // Midway to the next cell: a cell on the border would count in one run and not in another.
  const std::size_t half = (r.size() - 1) / 2, next = std::min(half + 1, r.size() - 1);
  m.radius = 0.5 * (r[half] + r[next]);
  m.border = mean(cells, &CellRecord::radius);
  return m;
}

/// Number density in the ball, 1/mm^3. Cells are weighted across a border as wide as their radius,
/// so that the density is continuous in their positions. NaN for a ball of radius 0.
double density_in(const CellRecords& cells, const TissueCenter& m) {
  if (m.radius == 0) return std::numeric_limits<double>::quiet_NaN();  // of one cell
  double count = 0;
  for (const auto& [id, c] : cells)
    count += std::clamp(0.5 + (m.radius - (c.center - m.center).norm()) / m.border, 0.0, 1.0);
  return 1e9 * count / sphere_volume(m.radius);
}

/// Root mean square over the cells in both runs.
/// @param squared  squared difference of two records of the same lineage
/// @return NaN if no cell is in both
template <class Squared>
double rms_by_lineage(const CellRecords& a, const CellRecords& b, Squared squared) {
  double sum = 0, n = 0;
  for (const auto& [id, c] : a)
    if (const auto other = b.find(id); other != b.end()) {
      sum += squared(c, other->second);
      ++n;
    }
  return n > 0 ? std::sqrt(sum / n) : std::numeric_limits<double>::quiet_NaN();
}

/// Relative difference; 0 if both are 0.
double ratio(double difference, double size) { return difference == 0 ? 0 : difference / size; }

/// Note on cells that only one of two runs has at the end: "3 of 12 cells of A and 0 of 9 of B are
/// not in the other at the end". Empty if both have the same cells.
std::string describe_unshared_cells(const std::string& folder_a, const CellRecords& a,
                                    const std::string& folder_b, const CellRecords& b) {
  const auto missing = [](const CellRecords& in, const CellRecords& from) {
    return std::ranges::count_if(in, [&](const auto& c) { return !from.contains(c.first); });
  };
  const auto only_a = missing(a, b), only_b = missing(b, a);
  if (only_a == 0 && only_b == 0) return {};
  return fmt::format("{} of {} cells of {} and {} of {} of {} are not in the other at the end",
                     only_a, a.size(), folder_a, only_b, b.size(), folder_b);
}

/// Quantity of one run, with its value in the reference.
struct Quantity {
  std::string name, unit;
  double reference = 0, value = 0;
};

/// Writer of the table of differences.
struct DifferenceTable {
  const std::map<std::string, double>& tolerance;
  Comparison& out;

  void add(std::size_t run, Difference row) const {
    if (const auto found = tolerance.find(row.name); found != tolerance.end())
      row.tolerance = found->second;
    if (row.not_measured.empty()) row.not_measured = out.gap[run - 1];
    out.difference[run - 1].push_back(std::move(row));
  }
  /// Adds rows for quantities with a tolerance that were not measured in all runs.
  void add_missing(std::size_t run) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [name, value] : tolerance)
      if (std::ranges::find(out.difference[run - 1], name, &Difference::name) ==
          out.difference[run - 1].end())
        add(run, {name,
                  "",
                  kNone,
                  kNone,
                  kNone,
                  false,
                  {},
                  fmt::format("{} was not measured in every frame of all runs", name),
                  false});
  }
  /// Adds an rms beside two values.
  /// @param difference    relative to the reference
  /// @param not_measured  reason for a missing verdict, empty if there is a verdict
  void rms(std::size_t run, const Quantity& q, double difference,
           const std::string& not_measured = {}) const {
    add(run, {q.name, q.unit, q.reference, q.value, difference, false, {}, not_measured, true});
  }
  /// Adds the relative change of a value.
  void change(std::size_t run, const Quantity& q, const std::string& not_measured = {}) const {
    const double change = ratio(std::abs(q.value - q.reference), std::abs(q.reference));
    add(run, {q.name, q.unit, q.reference, q.value, change, false, {}, not_measured, false});
  }
  /// Adds an rms in units of the quantity.
  void absolute(std::size_t run, const std::string& name, const std::string& unit,
                double difference, const std::string& not_measured = {}) const {
    add(run, {name, unit, 0, difference, difference, true, {}, not_measured, true});
  }
};

double average(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x / static_cast<double>(v.size());
  return sum;
}

/// Root mean square over time of the difference, relative to that of the reference.
double rms_over_time(const std::vector<double>& reference, const std::vector<double>& value) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    difference += std::pow(value[k] - reference[k], 2);
    size += std::pow(reference[k], 2);
  }
  return ratio(std::sqrt(difference), std::sqrt(size));
}

void record_trace(const DifferenceTable& record, std::size_t run, const Trace& t) {
  record.rms(run, {t.name, t.unit, average(t.value[0]), average(t.value[run])},
             rms_over_time(t.value[0], t.value[run]));
}

/// Series of the summary at the compared frames; empty if the run lacks it or any value is not
/// finite.
std::vector<double> measured(const ComparedRun& run, const std::string& name) {
  const auto found = run.summary.measures.find(name);
  std::vector<double> out;
  if (found == run.summary.measures.end() ||
      static_cast<int>(found->second.size()) != run.reader.n_frame())
    return out;
  for (const int k : run.frame) out.push_back(found->second[k]);
  if (!std::ranges::all_of(out, [](double v) { return std::isfinite(v); })) out.clear();
  return out;
}

void compare_measures(const std::vector<ComparedRun>& runs, const DifferenceTable& record,
                      Comparison& c) {
  struct Measure {
    const char *name, *series, *unit;
  };
  for (const Measure& m :
       {Measure{"lesion_area", "lesion_area_relative", "1"},
        Measure{"flooded_area", "lesion_area_flooded", "1"}, Measure{"overlap", "overlap", "1"},
        Measure{"normal_force", "normal_force_nN", "nN"}}) {
    Trace trace{m.name, m.unit, {}, {}};
    for (const ComparedRun& r : runs) trace.value.push_back(measured(r, m.series));
    if (std::ranges::any_of(trace.value, [](const auto& v) { return v.empty(); })) continue;
    for (const int k : runs[0].frame) trace.time.push_back(runs[0].reader.time_s(k));
    for (std::size_t r = 1; r < runs.size(); ++r) record_trace(record, r, trace);
    c.trace.push_back(std::move(trace));
  }
}

void check_names(const std::map<std::string, double>& tolerance) {
  std::vector<std::string> known;
  for (const auto& [name, meaning] : comparable_quantities()) known.push_back(name);
  for (const auto& [name, value] : tolerance) {
    const std::string all = fmt::format("Known: {}", fmt::join(known, ", "));
    check(comparable_quantities().contains(name),
          fmt::format("--tolerance {}: no such quantity. {}", name,
                      did_you_mean_and(nearest_name(name, known), all)));
    check(std::isfinite(value) && value >= 0,
          fmt::format("--tolerance {}={}: must be a number >= 0", name, value));
  }
}

/// Quantities followed over time, and the cells of every run at the end.
struct Traces {
  Trace count{"cells", "1", {}, {}}, pressure{"pressure", "Pa", {}, {}},
      force{"contact_force", "nN", {}, {}}, contacts{"contacts", "1", {}, {}};
  std::vector<CellRecords> end;  ///< [run]
};

Traces read_traces(const std::vector<ComparedRun>& runs) {
  Traces t;
  const auto all = {&t.count, &t.pressure, &t.force, &t.contacts};
  for (const ComparedRun& run : runs) {
    for (Trace* trace : all) trace->value.emplace_back();
    CellRecords cells;
    for (const int k : run.frame) {
      cells = read_cells(run.reader, k, run.summary.folder);
      t.count.value.back().push_back(static_cast<double>(cells.size()));
      t.pressure.value.back().push_back(mean(cells, &CellRecord::pressure));
      t.force.value.back().push_back(mean(cells, &CellRecord::force));
      t.contacts.value.back().push_back(mean(cells, &CellRecord::contacts));
    }
    t.end.push_back(cells);
  }
  for (const int k : runs[0].frame)
    for (Trace* trace : all) trace->time.push_back(runs[0].reader.time_s(k));
  return t;
}

double rms_of(const CellRecords& cells, double CellRecord::*what) {
  if (cells.empty()) return 0;
  double sum = 0;
  for (const auto& [id, cell] : cells) sum += std::pow(cell.*what, 2);
  return std::sqrt(sum / static_cast<double>(cells.size()));
}

/// Adds the rows of one run that come from its cells.
/// @param r  index of the run
void record_cells(const DifferenceTable& record, std::size_t r, const Traces& t) {
  const CellRecords &reference = t.end[0], &end = t.end[r];
  const std::string apart =
      describe_unshared_cells(record.out.runs[0], reference, record.out.runs[r], end);
  if (!apart.empty()) record.out.notes.push_back(apart);
  auto by_cell = [&](const char* name, const char* unit, double CellRecord::*what) {
    const double size = rms_of(reference, what);
    const double rms = rms_by_lineage(
        reference, end,
        [&](const CellRecord& a, const CellRecord& b) { return std::pow(a.*what - b.*what, 2); });
    record.rms(r, {name, unit, size, rms_of(end, what)}, ratio(rms, size), apart);
  };
  const TissueCenter middle = middle_of(reference);
  const double density = density_in(reference, middle), here = density_in(end, middle);
  record.change(r, {"cells", "1", t.count.value[0].back(), t.count.value[r].back()});
  record.absolute(r, "positions", "um",
                  rms_by_lineage(reference, end,
                                 [](const CellRecord& a, const CellRecord& b) {
                                   return (a.center - b.center).squaredNorm();
                                 }),
                  apart);
  record.change(r, {"density", "1/mm^3", density, here},
                std::isfinite(density) ? "" : "the density of a single cell is not defined");
  record_trace(record, r, t.pressure);
  by_cell("cell_pressure", "Pa", &CellRecord::pressure);
  record_trace(record, r, t.force);
  by_cell("cell_force", "nN", &CellRecord::force);
  record_trace(record, r, t.contacts);
}

/// Adds the drag of every run, and notes on different scenes and unshared frames.
void describe_runs(const std::vector<ComparedRun>& runs, const std::vector<CellRecords>& end,
                   std::optional<double> until, Comparison& c) {
  const std::string reference = runs[0].reader.provenance().at("scene");
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::string scene = runs[r].reader.provenance().at("scene");
    auto has = [&](bool deformable) {
      return std::ranges::any_of(
          end[r], [&](const auto& cell) { return cell.second.deformable == deformable; });
    };
    c.drag.push_back(drag_of(scene, has(true), has(false)));
    if (const std::string frames = describe_unshared_frames(runs[r], until); !frames.empty())
      c.notes.push_back(frames);
    if (r == 0) continue;
    const std::vector<std::string> other = list_scene_differences(reference, scene, may_differ);
    if (!other.empty())
      c.notes.push_back(fmt::format("{} is not the scene of {}: {}", c.runs[r], c.runs[0],
                                    fmt::join(other, "; ")));
  }
}

/// Records the runs without a verdict: they or the reference did not reach the judged time. A run
/// that ended early is named as the cause if others have no frame in common with it.
void record_shortfalls(const std::vector<ComparedRun>& runs, std::optional<double> until,
                       Comparison& c) {
  std::vector<Shortfall> gap;
  for (const ComparedRun& run : runs) gap.push_back(find_shortfall(run, until));
  std::string first;
  for (const Shortfall& g : gap)
    if (g.own) {
      c.notes.push_back(g.why);
      if (first.empty()) first = g.why;
    }
  for (const Shortfall& g : gap)
    if (first.empty() && !g.why.empty()) c.notes.push_back(first = g.why);
  for (std::size_t r = 1; r < runs.size(); ++r) {
    const bool none = gap[r].why.empty() && gap[0].why.empty();
    c.gap.push_back(none ? "" : gap[r].own ? gap[r].why : gap[0].own ? gap[0].why : first);
  }
}

}  // namespace

const std::map<std::string, std::string>& comparable_quantities() {
  static const std::map<std::string, std::string> names{
      {"cells", "number of cells at the end, change"},
      {"positions", "distance of the same cells at the end, um, rms over cells"},
      {"density",
       "cells per volume within the radius that contains half of the reference's cells, at the "
       "end, change"},
      {"pressure", "mean contact pressure, rms difference over time"},
      {"cell_pressure", "contact pressure of the same cells at the end, rms difference over cells"},
      {"contact_force", "mean contact force of a cell, rms difference over time"},
      {"cell_force", "contact force of the same cells at the end, rms difference over cells"},
      {"contacts", "mean number of cells a cell touches, rms difference over time"},
      {"lesion_area",
       "lesion area by the nearest cells (closed: below 0.05), rms difference over time"},
      {"flooded_area", "lesion area that is open to the central vein, rms difference over time"},
      {"overlap", "overlap of the central cell of a compressed clump, rms difference over time"},
      {"normal_force", "sum of the normal forces on the central cell, rms difference over time"},
      {"cpu", "CPU time, change"}};
  return names;
}

double Difference::change() const {
  return absolute ? std::numeric_limits<double>::quiet_NaN()
                  : ratio(value - reference, std::abs(reference));
}

double Difference::rms() const {
  return is_rms ? difference : std::numeric_limits<double>::quiet_NaN();
}

bool Comparison::passes() const {
  return std::ranges::all_of(difference, [](const std::vector<Difference>& run) {
    return std::ranges::all_of(run, &Difference::passes);
  });
}

Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::map<std::string, double>& tolerance,
                        std::optional<double> until) {
  check(folders.size() >= 2, "compare needs two run folders or more, the reference first");
  check_names(tolerance);
  const std::vector<ComparedRun> runs = open_compared_runs(folders, until);
  Comparison c;
  c.runs = folders;
  c.difference.resize(folders.size() - 1);
  record_shortfalls(runs, until, c);
  c.frames = static_cast<int>(runs[0].frame.size());
  c.from = runs[0].reader.time_s(runs[0].frame.front());
  c.to = runs[0].reader.time_s(runs[0].frame.back());
  const Traces traces = read_traces(runs);
  check(!traces.end[0].empty(), fmt::format("{}: no cells in its last frame", folders[0]));
  const DifferenceTable record{tolerance, c};
  for (std::size_t r = 1; r < runs.size(); ++r) record_cells(record, r, traces);
  c.trace = {traces.count, traces.pressure, traces.force, traces.contacts};
  compare_measures(runs, record, c);
  for (std::size_t r = 1; r < runs.size(); ++r)
    record.change(r, {"cpu", "s", runs[0].summary.cpu_s, runs[r].summary.cpu_s});
  for (std::size_t r = 1; r < runs.size(); ++r) record.add_missing(r);
  describe_runs(runs, traces.end, until, c);
  return c;
}

}  // namespace acinus::runs
