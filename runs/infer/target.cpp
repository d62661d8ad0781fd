#include "runs/infer/target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "geometry/readers/input_file.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

/// Reader of the table, line by line.
class TargetFile {
 public:
  TargetFile(const std::string& path, const std::map<std::string, std::string>& units, double end)
      : file_(path), units_(units), end_(end) {
    file_.skip_byte_order_mark();
  }

  std::vector<TargetPoint> read() {
    constexpr std::size_t kMost = 100000;
    std::vector<TargetPoint> all;
    while (file_.remaining() > 0) {
      place_ = file_.position();
      const std::string_view line = file_.next_line();
      const std::vector<std::string> field = geometry::split_fields(line, ',', " \t\r\"");
      if (line.starts_with('#') || (field.size() == 1 && field[0].empty())) continue;
      if (column_.empty())
        take_head(field);
      else
        all.push_back(point_of(field));
      if (all.size() > kMost) fail(fmt::format("more than {} values", kMost));
    }
    check(!all.empty(),
          fmt::format("{}: holds no values. A head \"time_s,observable,value,sd\" and "
                      "lines of values are needed.",
                      file_.path()));
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { file_.fail_at(place_, message); }

  void take_head(const std::vector<std::string>& field) {
    constexpr std::array<std::pair<const char*, double>, 4> kTimes{
        {{"time_s", 1}, {"time_min", 60}, {"time_h", 3600}, {"time_days", 86400}}};
    for (std::size_t k = 0; k < field.size(); ++k) {
      const auto time = std::ranges::find(kTimes, field[k], [](const auto& t) { return t.first; });
      if (time != kTimes.end()) seconds_ = time->second;
      const std::string name = time != kTimes.end() ? "time" : field[k];
      if (!column_.emplace(name, k).second) fail(fmt::format("column {} twice", name));
    }
    for (const char* name : {"observable", "value", "sd"})
      if (!column_.contains(name))
        fail(
            fmt::format("no column {} in the head; time_s, time_min, time_h or time_days, and "
                        "observable, value, sd are needed",
                        name));
  }

  std::string text(const std::vector<std::string>& field, const char* name) const {
    const auto at = column_.find(name);
    if (at == column_.end()) return {};
    if (at->second >= field.size()) fail(fmt::format("{} is missing", name));
    return field[at->second];
  }

  double number(const std::vector<std::string>& field, const char* name) const {
    double value = 0;
    const std::string found = text(field, name);
    if (!geometry::parse_double(found, value) || !std::isfinite(value))
      fail(fmt::format("{} is {}; a number is needed", name, geometry::in_quotes(found)));
    return value;
  }

  TargetPoint point_of(const std::vector<std::string>& field) const {
    TargetPoint p;
    p.observable = text(field, "observable");
    const auto unit = units_.find(p.observable);
    if (unit == units_.end()) {
      std::vector<std::string> names;
      for (const auto& [name, u] : units_) names.push_back(name);
      fail(fmt::format("{} is no observable of the scene. {}", geometry::in_quotes(p.observable),
                       did_you_mean(nearest_name(p.observable, names),
                                    fmt::format("Known: {}", fmt::join(names, ", ")))));
    }
    const std::string said = text(field, "unit");
    const double scale = said.empty() || said == unit->second ? 1 : scale_of(said, unit->second);
    p.value = scale * number(field, "value");
    p.sd = scale * number(field, "sd");
    if (!(p.sd > 0)) fail("sd must be above 0: the standard error of the value");
    if (!text(field, "time").empty()) {
      p.time = seconds_ * number(field, "time");
      if (*p.time < 0 || *p.time > end_)
        fail(fmt::format("the time {:.6g} s lies outside the run, 0 to {:.6g} s. Set time.end",
                         *p.time, end_));
    }
    return p;
  }

  double scale_of(const std::string& from, const std::string& to) const {
    Node one;
    one.kind = Node::Kind::kText;
    one.text = "1 " + from;
    try {
      return number_in(one, to);
    } catch (const Error&) {
      fail(fmt::format("the unit is {}; {} is needed, or one that it can be converted to",
                       geometry::in_quotes(from), to));
    }
  }

  geometry::InputFile file_;
  const std::map<std::string, std::string>& units_;
  double end_;
  std::map<std::string, std::size_t> column_;
  double seconds_ = 1;
  std::size_t place_ = 0;
};

}  // namespace

std::vector<TargetPoint> read_target(const std::string& path,
                                     const std::map<std::string, std::string>& units, double end) {
  return TargetFile(path, units, end).read();
}

std::vector<double> values_at(std::span<const TargetPoint> target,
                              const std::map<std::string, TimeCurve>& curves) {
  std::vector<double> values;
  for (const TargetPoint& p : target) {
    const auto found = curves.find(p.observable);
    if (found == curves.end() || found->second.time.empty()) return {};
    const std::optional<double> value =
        p.time ? value_at(found->second, *p.time) : found->second.value.back();
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

double distance_to(std::span<const TargetPoint> target, std::span<const double> values) {
  if (values.size() != target.size()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (std::size_t k = 0; k < target.size(); ++k) {
    const double d = (values[k] - target[k].value) / target[k].sd;
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(target.size()));
}

}  // namespace acinus::runs
