#pragma once
/// Piecewise linear function of time.

#include <algorithm>
#include <limits>
#include <vector>

namespace acinus {

/// Piecewise linear values over time, constant before the first entry and after the last. Two
/// entries of one time are a jump: the later one holds from then on.
struct Schedule {
  struct Point {
    double time = 0;  ///< s
    double value = 0;
  };
  std::vector<Point> entry;  ///< times never decrease

  /// Value at a time, s. @pre there is an entry
  double at(double time) const {
    const auto after = std::ranges::upper_bound(entry, time, {}, &Point::time);
    if (after == entry.begin()) return after->value;
    const Point& a = *std::prev(after);
    if (after == entry.end()) return a.value;
    return a.value + (after->value - a.value) * (time - a.time) / (after->time - a.time);
  }

  /// Time of the first entry later than `time`, s; infinite if there is none.
  double next(double time) const {
    const auto after = std::ranges::upper_bound(entry, time, {}, &Point::time);
    return after == entry.end() ? std::numeric_limits<double>::infinity() : after->time;
  }
};

}  // namespace acinus
