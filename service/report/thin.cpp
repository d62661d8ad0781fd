#include "service/report/thin.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::service {

std::vector<int> choose_evenly(int count, int n) {
  std::vector<int> chosen;
  n = std::min(count, n);
  if (n == 1) return {count - 1};
  for (int k = 0; k < n; ++k)
    chosen.push_back(static_cast<int>(std::llround(1.0 * k * (count - 1) / (n - 1))));
  return chosen;
}

runs::TimeCurve thin_curve(const runs::TimeCurve& curve, int n) {
  const int count = static_cast<int>(curve.time.size());
  if (count <= n) return curve;
  runs::TimeCurve thin;
  const int stretches = std::max(1, n / 2);
  for (int s = 0; s < stretches; ++s) {
    const auto begin = curve.value.begin() + 1L * s * count / stretches;
    const auto end = curve.value.begin() + (s + 1L) * count / stretches;
    const auto [low, high] = std::minmax_element(begin, end);
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      thin.time.push_back(curve.time[at - curve.value.begin()]);
      thin.value.push_back(*at);
      if (low == high) break;
    }
  }
  return thin;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

}  // namespace acinus::service
