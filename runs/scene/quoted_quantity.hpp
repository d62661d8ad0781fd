#pragma once
/// Quantities as a scene writes them, in quotes, for messages.

#include <string>

#include "core/units/units.hpp"

namespace acinus::runs {

/// Quantity in quotes, in its preferred unit: "5 um".
/// @param value  in base units
inline std::string quoted_quantity(double value, Dimension dimension, const char* unit) {
  return "\"" + format_quantity(value, dimension, unit) + "\"";
}

/// Time in quotes, such as "5 s".
inline std::string quoted_time(double value) { return quoted_quantity(value, kTime, "s"); }

/// Length in quotes.
inline std::string quoted_length(double value) { return quoted_quantity(value, kLength, "um"); }

}  // namespace acinus::runs
