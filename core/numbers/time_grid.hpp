#pragma once
/// Fixed time grids on which things are looked at, whatever the steps are.

#include <cmath>
#include <cstdint>

namespace acinus {

/// Two times this near are the same, s: sums of steps that end at one time differ by rounding.
inline constexpr double kSameTime = 1e-6;

/// Share of an interval by which a sum of steps may fall short of its end.
inline constexpr double kGridSlack = 1e-9;

/// Number of the interval a time is in.
inline std::int64_t grid_interval(double time, double grid) {
  return static_cast<std::int64_t>(std::floor(time / grid + kGridSlack));
}

/// Whether a step from one time to another ends in another interval than it began in.
inline bool crosses_grid(double before, double now, double grid) {
  return grid_interval(before, grid) != grid_interval(now, grid);
}

/// Time until the next interval begins.
inline double time_to_next_interval(double time, double grid) {
  return (std::floor(time / grid + kGridSlack) + 1) * grid - time;
}

}  // namespace acinus
