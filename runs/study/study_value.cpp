#include "runs/study/study_value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/units/units.hpp"

namespace acinus::runs {

double number_in(const Node& value, const std::string& unit) {
  const UnitScale scale = scale_of_unit(unit);
  const bool is_number = value.kind == Node::Kind::kInteger || value.kind == Node::Kind::kNumber;
  if (scale.dimension == kDimensionless) {
    check(is_number || value.kind == Node::Kind::kText, "must be a number");
    return is_number ? value.number / scale.in_base : parse_quantity(value.text, kDimensionless);
  }
  check(value.kind == Node::Kind::kText,
        fmt::format("must be a text with a unit such as \"1 {}\"", unit));
  return parse_quantity(value.text, scale.dimension) / scale.in_base;
}

std::string unit_of(const StudyMeasure& measure, const std::map<std::string, std::string>& units) {
  if (measure.kind == MeasureKind::kPValue) return "1";
  if (is_passage(measure)) return "s";
  return units.at(measure.observable);
}

std::string show_value(double v, const std::string& unit) {
  if (std::isinf(v)) return v > 0 ? "never" : "before what never happens";
  if (unit == "1") return fmt::format("{:.4g}", v);
  if (unit != "s") return fmt::format("{:.4g} {}", v, unit);
  const double size = std::abs(v);
  if (size >= 86400) return fmt::format("{:.3g} d", v / 86400);
  if (size >= 3600) return fmt::format("{:.3g} h", v / 3600);
  return size >= 120 ? fmt::format("{:.3g} min", v / 60) : fmt::format("{:.3g} s", v);
}

}  // namespace acinus::runs
