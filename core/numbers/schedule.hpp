#pragma once
/// A value that is known at some times and runs straight between them.

#include <algorithm>
#include <limits>
#include <vector>

namespace acinus {

/// Two entries of one time are a jump: the later one holds from then on. Before the first entry and
/// after the last the value is theirs.
struct Schedule {
  struct Point {
    double time = 0;  ///< s
    double value = 0;
  };
  std::vector<Point> entry;  ///< times never fall

  /// @pre there is an entry
  double at(double time) const {
    const auto after = std::ranges::upper_bound(entry, time, {}, &Point::time);
    if (after == entry.begin()) return after->value;
    const Point& a = *std::prev(after);
    if (after == entry.end()) return a.value;
    return a.value + (after->value - a.value) * (time - a.time) / (after->time - a.time);
  }

  /// The time of the first entry later than `time`; infinite if there is none.
  double next(double time) const {
    const auto after = std::ranges::upper_bound(entry, time, {}, &Point::time);
    return after == entry.end() ? std::numeric_limits<double>::infinity() : after->time;
  }
};

}  // namespace acinus
