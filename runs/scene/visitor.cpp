#include "runs/scene/visitor.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units/units.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string range_text(const Range& range, Dimension dimension, const char* unit) {
  const auto bound = [&](double value) { return format_quantity(value, dimension, unit); };
  const bool has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
  if (has_low && has_high) {
    if (!range.low_open && !range.high_open) {
      return fmt::format("from {} to {}", bound(range.low), bound(range.high));
    }
    return fmt::format("{} {} and {} {}", range.low_open ? ">" : ">=", bound(range.low),
                       range.high_open ? "<" : "<=", bound(range.high));
  }
  if (has_low) return fmt::format("{} {}", range.low_open ? ">" : ">=", bound(range.low));
  if (has_high) return fmt::format("{} {}", range.high_open ? "<" : "<=", bound(range.high));
  return "";
}

std::vector<std::string> choices_of(const Key& key) { return split_choices(key.choices); }

}  // namespace acinus::runs
