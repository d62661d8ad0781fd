#pragma once
/// How a quantity goes back after a load is taken away: at once, then slowly, and how long in all.

#include <limits>
#include <span>

namespace acinus::calibration {

/// The way back ends where as long again brings less than a hundredth more. A clump that is let go
/// first gets its shape back, then creeps on towards a ball, slower and slower: without an end of
/// this kind every time would be a share of how long one looked. While there is none yet, the
/// farthest value stands for it and the time is not known.
struct Recovery {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double end = kUnknown;     ///< the value at the end of the way
  double sprung = kUnknown;  ///< share of the way done 10 s after the release
  double efold = kUnknown;   ///< s in which what was left then falls to 1/e
  double time = kUnknown;    ///< s until 1 % of the way is left
};

/// @param t  [n] s since the release, ascending from 0
/// @param y  [n] the quantity
Recovery measure_recovery(std::span<const double> t, std::span<const double> y);

/// The quantity at a time between samples; the last value later on.
double value_at(double time, std::span<const double> t, std::span<const double> y);

}  // namespace acinus::calibration
