#include "runs/study/check_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "core/units/units.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

class Checker {
 public:
  Checker(const StudyPlan& plan, Report& report) : plan_(plan), report_(report) {}

  void check_all() {
    const Study& study = plan_.study;
    for (std::size_t k = 0; k < study.observables.size(); ++k)
      check_observable(study.observables[k], fmt::format("/observables/{}", k));
    std::set<std::string> names;
    for (std::size_t k = 0; k < study.plots.size(); ++k) {
      const std::string pointer = fmt::format("/plots/{}", k);
      if (!names.insert(study.plots[k].name).second)
        add(pointer + "/name", "another plot has this name");
      check_plot(study.plots[k], pointer);
    }
    for (std::size_t k = 0; k < study.figures.size(); ++k)
      check_figure(study.figures[k], fmt::format("/figures/{}", k), names);
    for (std::size_t k = 0; k < study.maps.size(); ++k) {
      const std::string pointer = fmt::format("/maps/{}", k);
      if (!names.insert(study.maps[k].name).second)
        add(pointer + "/name", "another plot, figure or map has this name");
      check_map(study.maps[k], pointer);
    }
    std::set<std::string> ids;
    for (std::size_t k = 0; k < study.expectations.size(); ++k) {
      const std::string pointer = fmt::format("/expectations/{}", k);
      if (!ids.insert(study.expectations[k].id).second)
        add(pointer + "/id", "another expectation has this id");
      check_expectation(study.expectations[k], pointer);
    }
  }

 private:
  void add(const std::string& pointer, const std::string& message) {
    report_.add_relation({pointer}, "", message);
  }

  bool check_observable(const std::string& name, const std::string& pointer) {
    if (report_.is_bad(pointer) || name.empty()) return false;
    if (plan_.units.contains(name)) return true;
    std::vector<std::string> names;
    for (const auto& [known, unit] : plan_.units) names.push_back(known);
    const std::string known = fmt::format("Known: {}", fmt::join(names, ", "));
    add(pointer, "unknown observable. " + did_you_mean(nearest_name(name, names), known));
    return false;
  }

  void check_variant(const std::string& name, const std::string& pointer, bool one) {
    if (report_.is_bad(pointer) || name.empty()) return;
    if (find_variants(plan_.variants, name).empty() || (one && name.ends_with("/*")))
      add(pointer, unknown_variant(plan_.variants, name));
  }

  void check_number(const Node& value, const std::string& unit, const std::string& pointer) {
    try {
      number_in(value, unit);
    } catch (const Error& error) {
      const std::string message = error.what(), before = "\"" + value.text + "\": ";
      add(pointer, message.starts_with(before) ? message.substr(before.size()) : message);
    }
  }

  /// Checks that a claim has at least one bound.
  /// @param claim  expectation or map
  void check_bound_given(const auto& claim, const std::string& pointer) {
    if (!claim.low && !claim.high)
      add(pointer + "/low", "is missing, and so is high: what is expected?");
  }

  void check_bounds(const auto& claim, const std::string& unit, const std::string& pointer) {
    if (claim.low) check_number(*claim.low, unit, pointer + "/low");
    if (claim.high) check_number(*claim.high, unit, pointer + "/high");
  }

  void check_plot(const StudyPlot& plot, const std::string& pointer) {
    const bool known = check_observable(plot.observable, pointer + "/observable");
    for (std::size_t k = 0; k < plot.beside.size(); ++k) {
      const std::string place = fmt::format("{}/beside/{}", pointer, k);
      if (check_observable(plot.beside[k], place) && known &&
          plan_.units.at(plot.beside[k]) != plan_.units.at(plot.observable))
        add(place, fmt::format("is in {}, the observable of the plot in {}",
                               plan_.units.at(plot.beside[k]), plan_.units.at(plot.observable)));
    }
    for (std::size_t k = 0; k < plot.variants.size(); ++k)
      check_variant(plot.variants[k], fmt::format("{}/variants/{}", pointer, k), false);
    std::string x_unit = "s";
    if (!plot.over.empty()) {
      const std::optional<std::string> unit = unit_of_key(plot.over);
      if (!unit) {
        add(pointer + "/over", "is no key of a scene with one number as value");
        return;
      }
      x_unit = *unit;
    }
    for (std::size_t k = 0; k < plot.reference.size() && known; ++k)
      check_reference(plot.reference[k], fmt::format("{}/reference/{}", pointer, k), x_unit,
                      plan_.units.at(plot.observable));
  }

  /// Checks a figure and adds its name.
  /// @param names  names of the plots and of earlier figures
  void check_figure(const StudyFigure& figure, const std::string& pointer,
                    std::set<std::string>& names) {
    std::vector<std::string> plots;
    for (const StudyPlot& plot : plan_.study.plots) plots.push_back(plot.name);
    if (figure.plots.empty()) add(pointer + "/plots", "is empty: name at least one plot");
    for (std::size_t k = 0; k < figure.plots.size(); ++k)
      if (std::ranges::find(plots, figure.plots[k]) == plots.end())
        add(fmt::format("{}/plots/{}", pointer, k),
            "unknown plot. " + did_you_mean(nearest_name(figure.plots[k], plots),
                                            fmt::format("Known: {}", fmt::join(plots, ", "))));
    if (!names.insert(figure.name).second)
      add(pointer + "/name", "another plot or figure has this name");
  }

  void check_map(const StudyMap& map, const std::string& pointer) {
    for (std::size_t k = 0; k < map.variants.size(); ++k)
      check_variant(map.variants[k], fmt::format("{}/variants/{}", pointer, k), false);
    for (const auto& [key, name] : {std::pair{&map.x, "/x"}, {&map.y, "/y"}})
      if (!key->empty() && !unit_of_key(*key))
        add(pointer + name, "is no key of a scene with one number as value");
    check_measure(map.measure, pointer + "/measure");
    check_bound_given(map, pointer);
    if (plan_.units.contains(map.measure.observable))
      check_bounds(map, unit_of(map.measure, plan_.units), pointer);
  }

  void check_reference(const StudyReference& r, const std::string& pointer,
                       const std::string& x_unit, const std::string& y_unit) {
    const auto numbers = [&](const std::vector<Node>& values, const char* key,
                             const std::string& unit) {
      for (std::size_t k = 0; k < values.size(); ++k)
        check_number(values[k], unit, fmt::format("{}/{}/{}", pointer, key, k));
      if (values.size() != r.x.size() && !values.empty())
        add(pointer + "/" + key, fmt::format("has {} values, x has {}", values.size(), r.x.size()));
    };
    numbers(r.x, "x", x_unit);
    numbers(r.y, "y", y_unit);
    numbers(r.low, "low", y_unit);
    numbers(r.high, "high", y_unit);
    if (r.y.empty() != r.x.empty()) add(pointer + "/y", "must have as many values as x");
    if (r.low.empty() != r.high.empty())
      add(pointer + "/low", "low and high go together: give both or none");
  }

  /// Checks that a time is not after the end of the runs that the measure needs.
  void check_within_runs(double time, const StudyMeasure& m, const std::string& pointer) {
    for (const StudyRun& run : plan_.runs) {
      const std::string& name = plan_.variant_of(run).name;
      if (name != m.variant && name != m.other && name != m.another) continue;
      if (time <= run.scene.time.end) continue;
      add(pointer, fmt::format("{} is after the end of {} at {}", show_value(time, "s"), name,
                               show_value(run.scene.time.end, "s")));
      return;
    }
  }

  void check_measure(const StudyMeasure& m, const std::string& pointer) {
    const bool known = check_observable(m.observable, pointer + "/observable");
    check_variant(m.variant, pointer + "/variant", true);
    check_variant(m.other, pointer + "/other", true);
    check_variant(m.another, pointer + "/another", true);
    for (const auto& [time, key] : {std::pair{m.at, "/at"}, {m.from, "/from"}, {m.until, "/until"}})
      if (time) check_within_runs(*time, m, pointer + key);
    if (known && m.level) check_number(*m.level, plan_.units.at(m.observable), pointer + "/level");
    if (m.from && m.until && *m.from >= *m.until) add(pointer + "/from", "must be before until");
  }

  void check_expectation(const StudyExpectation& e, const std::string& pointer) {
    check_measure(e.measure, pointer + "/measure");
    if (e.minus) check_measure(*e.minus, pointer + "/minus");
    if (e.over) check_measure(*e.over, pointer + "/over");
    if (e.minus && e.over) {
      add(pointer + "/over", "a measure has minus or over, not both");
      return;
    }
    if (e.every_seed && e.least_seeds > 0)
      add(pointer + "/least_seeds", "every_seed asks for all of them: give one of the two");
    check_bound_given(e, pointer);
    if (!plan_.units.contains(e.measure.observable)) return;
    std::string unit = unit_of(e.measure, plan_.units);
    for (const auto& [second, key] : {std::pair{&e.minus, "/minus"}, {&e.over, "/over"}}) {
      if (!*second || !plan_.units.contains((*second)->observable)) continue;
      const std::string other = unit_of(**second, plan_.units);
      if (scale_of_unit(other).dimension != scale_of_unit(unit).dimension)
        add(pointer + key,
            fmt::format("is in {}, the first measure in {}: they cannot be compared", other, unit));
    }
    if (e.over) unit = "1";
    check_bounds(e, unit, pointer);
  }

  const StudyPlan& plan_;
  Report& report_;
};

}  // namespace

void check_study(const StudyPlan& plan, Report& report) { Checker(plan, report).check_all(); }

}  // namespace acinus::runs
