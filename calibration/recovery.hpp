#pragma once
/// How a quantity goes back after a load is taken away: at once, then slowly, and how long in all.

#include <limits>
#include <span>

namespace acinus::calibration {

/// The way is from the first value to the one farthest from it: what comes later, such as a clump
/// that goes on to round off, is another matter. NaN: there is no way, or it was not followed long
/// enough to tell.
struct Recovery {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double end = kUnknown;     ///< the value at the end of the way, as far as it was followed
  double sprung = kUnknown;  ///< share of the way done 10 s after the release
  double efold = kUnknown;   ///< s in which what was left then falls to 1/e
  double time = kUnknown;    ///< s until 1 % of the way is left
};

/// All but the end is known only if 99 % of the way are done in the first half of the time: what
/// still moves may go farther.
/// @param t  [n] s since the release, ascending from 0
/// @param y  [n] the quantity
Recovery measure_recovery(std::span<const double> t, std::span<const double> y);

}  // namespace acinus::calibration
