#include "calibration/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace acinus::calibration {
namespace {

constexpr double kImmediate = 10;       ///< s, end of the immediate recovery
constexpr double kEndShare = 0.01;      ///< share of the recovery that does not count
constexpr double kLeastProgress = 0.5;  ///< share of the largest recovery before its end
constexpr double kNegligible = 1e-12;   ///< relative to the values: no recovery

/// End of the recovery: the first time at which as long again brings less than 1 % more, and the
/// value after that; an infinite time if the record is too short. Not before half of the recovery,
/// lest a single turn of the curve be taken for its end.
struct RecoveryEnd {
  double time = std::numeric_limits<double>::infinity(), value = 0;
};
RecoveryEnd find_end(std::span<const double> t, std::span<const double> y) {
  const double farthest =
      *std::ranges::max_element(y, {}, [&](double v) { return std::abs(v - y.front()); });
  const double most = kLeastProgress * std::abs(farthest - y.front());
  for (std::size_t k = 1; k < t.size() && 2 * t[k] <= t.back(); ++k) {
    const double later = value_at(2 * t[k], t, y);
    if (t[k] >= kImmediate && std::abs(y[k] - y.front()) >= most &&
        std::abs(later - y[k]) <= kEndShare * std::abs(later - y.front()))
      return {t[k], later};
  }
  return {std::numeric_limits<double>::infinity(), farthest};
}

/// Time at which a falling line between samples k - 1 and k crosses a level.
double crossing(double level, std::size_t k, std::span<const double> t, std::span<const double> y) {
  const double drop = y[k - 1] - y[k];
  const double share = drop != 0 ? (y[k - 1] - level) / drop : 1;
  return t[k - 1] + std::clamp(share, 0.0, 1.0) * (t[k] - t[k - 1]);
}

}  // namespace

double value_at(double time, std::span<const double> t, std::span<const double> y) {
  const std::size_t next = std::ranges::lower_bound(t, time) - t.begin();
  if (next == 0) return y.front();
  if (next == t.size()) return y.back();
  const double share = (time - t[next - 1]) / (t[next] - t[next - 1]);
  return y[next - 1] + share * (y[next] - y[next - 1]);
}

Recovery measure_recovery(std::span<const double> t, std::span<const double> y) {
  Recovery r;
  if (t.size() < 2 || !(t.back() > kImmediate)) return r;
  const RecoveryEnd end = find_end(t, y);
  const double way = end.value - y.front();
  if (!(std::abs(way) > kNegligible * std::max(std::abs(end.value), std::abs(y.front())))) return r;
  r.end = end.value;
  std::vector<double> left;  // share of the way
  for (const double v : y) left.push_back((r.end - v) / way);
  const auto first_below = [&](double level, double after) {
    for (std::size_t k = 1; k < t.size(); ++k)
      if (t[k] > after && left[k] <= level) return std::max(after, crossing(level, k, t, left));
    return t.back();
  };
  if (std::isfinite(end.time)) r.time = first_below(kEndShare, 0);
  const double slow = value_at(kImmediate, t, left);
  r.sprung = 1 - slow;
  // Of what is there already nothing is left to be slow.
  if (slow > kEndShare) r.efold = first_below(slow / std::exp(1), kImmediate) - kImmediate;
  return r;
}

}  // namespace acinus::calibration
