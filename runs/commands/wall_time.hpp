#pragma once
/// Wall times of the command line.

#include <string>

namespace acinus::runs {

/// Wall-clock time such as "10min", "23h30m", "600 s", "1d" in s. Here m means minutes.
/// @throws Error naming the text
double parse_wall_time(const std::string& text);

}  // namespace acinus::runs
