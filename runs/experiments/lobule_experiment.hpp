#pragma once
/// Closing of a central lesion of a lobule.

#include <optional>
#include <vector>

namespace acinus::runs {

/// Closing time, days: when a relative area is first below 0.05, between frames by linear
/// interpolation; none if it never is.
/// @param time_d  of the values
std::optional<double> closing_time(const std::vector<double>& time_d,
                                   const std::vector<double>& area);

}  // namespace acinus::runs
