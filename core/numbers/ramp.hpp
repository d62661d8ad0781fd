#pragma once
/// Linear ramp of a value between two times.

namespace acinus {

struct Ramp {
  double from = 0, to = 0;    ///< values at start and end
  double start = 0, end = 0;  ///< s

  static Ramp constant(double value) { return {value, value, 0, 0}; }
  double at(double time) const {
    if (time >= end) return to;
    if (time <= start) return from;
    return from + (to - from) * (time - start) / (end - start);
  }
  /// Slope to the right of a time.
  double slope_at(double time) const {
    return time >= start && time < end ? (to - from) / (end - start) : 0;
  }
};

}  // namespace acinus
