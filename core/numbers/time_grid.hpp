#pragma once
/// Fixed time grids for output and events, independent of the steps.

#include <cmath>
#include <cstdint>

namespace acinus {

/// Difference below which two times count as equal, s: sums of steps that end at one time differ by
/// rounding.
inline constexpr double kSameTime = 1e-6;

/// Share of an interval by which a sum of steps may fall short of its end.
inline constexpr double kGridSlack = 1e-9;

/// Number of the grid interval that contains a time.
inline std::int64_t grid_interval(double time, double grid) {
  return static_cast<std::int64_t>(std::floor(time / grid + kGridSlack));
}

/// True if a step from `before` to `now` ends in another grid interval than it began in.
inline bool crosses_grid(double before, double now, double grid) {
  return grid_interval(before, grid) != grid_interval(now, grid);
}

/// Time until the next grid interval begins, s.
inline double time_to_next_interval(double time, double grid) {
  return (std::floor(time / grid + kGridSlack) + 1) * grid - time;
}

}  // namespace acinus
