#pragma once
/// Quantities as a scene writes them, in quotes, for messages.

#include <string>

#include "core/units/units.hpp"

namespace acinus::runs {

/// @param value  in the unit of this program
inline std::string quoted_quantity(double value, Dimension dimension, const char* unit) {
  return "\"" + format_quantity(value, dimension, unit) + "\"";
}

/// "\"5 s\""
inline std::string quoted_time(double value) { return quoted_quantity(value, kTime, "s"); }

/// "\"5 um\""
inline std::string quoted_length(double value) { return quoted_quantity(value, kLength, "um"); }

}  // namespace acinus::runs
