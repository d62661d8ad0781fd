#pragma once
/// Recovery of a quantity after a load is removed: at once, then slowly, and in total.

#include <limits>
#include <span>

namespace acinus::calibration {

/// Recovery after unloading. It ends where as long again brings less than a hundredth more. A
/// released clump first regains its shape, then relaxes towards a ball ever more slowly: without
/// such an end every time would be a share of the time simulated. While there is no end yet, the
/// farthest value stands for it and the time is unknown.
struct Recovery {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double end = kUnknown;     ///< value at the end of the recovery
  double sprung = kUnknown;  ///< share of the recovery within 10 s after the release
  double efold = kUnknown;   ///< s in which the rest then falls to 1/e
  double time = kUnknown;    ///< s until 1 % of the recovery is left
};

/// Measures a recovery.
/// @param t  [n] s since the release, ascending from 0
/// @param y  [n] the quantity
Recovery measure_recovery(std::span<const double> t, std::span<const double> y);

/// Value at a time between samples; the last value at later times.
double value_at(double time, std::span<const double> t, std::span<const double> y);

}  // namespace acinus::calibration
