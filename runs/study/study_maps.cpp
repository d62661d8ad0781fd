#include "runs/study/study_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/sort_unique.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/study_measures.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

/// Values of the two keys in the scene of a variant; empty if it lacks one.
std::optional<std::pair<double, double>> place_of(const StudyPlan& plan, std::size_t variant,
                                                  const StudyMap& wanted) {
  for (const StudyRun& run : plan.runs) {
    if (run.variant != variant) continue;
    const auto x = value_of_key(run.scene, wanted.x), y = value_of_key(run.scene, wanted.y);
    if (x && y) return std::pair(*x, *y);
    break;
  }
  return std::nullopt;
}

std::string with_unit(double value, const std::string& key) {
  const std::string unit = unit_of_key(key).value_or("1");
  return unit == "1" ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, unit);
}

io::HeatField make_field(const StudyPlan& plan, const StudyData& data, const StudyMap& wanted,
                         std::size_t variant) {
  StudyMeasure measure = wanted.measure;
  measure.variant = plan.variants[variant].name;
  const Measured m = take_measure(plan, data, measure);
  if (!m.value) return {{}, {"not measured"}};
  std::optional<double> low, high;
  if (wanted.low) low = number_in(*wanted.low, m.unit);
  if (wanted.high) high = number_in(*wanted.high, m.unit);
  const int within = seeds_within(m, low, high), all = static_cast<int>(m.by_seed.size());
  return {static_cast<double>(within) / all,
          {show_value(*m.value, m.unit), fmt::format("{} of {} seeds", within, all)}};
}

std::string describe_bounds(const StudyMap& wanted, const StudyPlan& plan) {
  const std::string unit = unit_of(wanted.measure, plan.units);
  const auto show = [&](const Node& bound) { return show_value(number_in(bound, unit), unit); };
  if (wanted.low && wanted.high)
    return fmt::format("seeds from {} to {}", show(*wanted.low), show(*wanted.high));
  return wanted.low ? "seeds at or above " + show(*wanted.low)
                    : "seeds at or below " + show(*wanted.high);
}

}  // namespace

io::HeatMap make_map(const StudyPlan& plan, const StudyData& data, const StudyMap& wanted) {
  struct MapPlace {
    std::size_t variant;
    double x, y;
  };
  std::vector<MapPlace> fields;
  std::vector<double> xs, ys;
  const std::vector<std::string> all{"*"};
  for (const std::string& name : wanted.variants.empty() ? all : wanted.variants)
    for (const std::size_t v : find_variants(plan.variants, name))
      if (const auto place = place_of(plan, v, wanted)) {
        fields.push_back({v, place->first, place->second});
        xs.push_back(place->first);
        ys.push_back(place->second);
      }
  for (std::vector<double>* values : {&xs, &ys}) {
    sort_unique(*values);
  }
  io::HeatMap map;
  map.title = wanted.title.empty() ? wanted.name : wanted.title;
  map.x_label = wanted.x;
  map.y_label = wanted.y;
  map.scale_label = describe_bounds(wanted, plan);
  for (const double x : xs) map.column.push_back(with_unit(x, wanted.x));
  for (const double y : ys) map.row.push_back(with_unit(y, wanted.y));
  map.field.assign(ys.size(), std::vector<io::HeatField>(xs.size()));
  for (const MapPlace& f : fields) {
    const auto row = std::ranges::lower_bound(ys, f.y) - ys.begin();
    const auto column = std::ranges::lower_bound(xs, f.x) - xs.begin();
    map.field[row][column] = make_field(plan, data, wanted, f.variant);
  }
  return map;
}

std::vector<std::string> write_maps(const StudyPlan& plan, const StudyData& data,
                                    const std::string& root) {
  std::vector<std::string> files;
  for (const StudyMap& wanted : plan.study.maps) {
    files.push_back(wanted.name + ".svg");
    io::write_heat_map(root + "/plots/" + files.back(), make_map(plan, data, wanted));
  }
  return files;
}

}  // namespace acinus::runs
