#include "calibration/curve.hpp"

#include <algorithm>
#include <limits>

namespace acinus::calibration {

ForceCurve loading_branch(std::span<const double> overlap, std::span<const double> force) {
  ForceCurve curve;
  if (overlap.empty()) return curve;
  const std::size_t last = std::ranges::max_element(overlap) - overlap.begin();
  std::size_t first = last;
  while (first > 0 && overlap[first - 1] < overlap[first]) --first;
  for (std::size_t k = first; k <= last; ++k) {
    curve.overlap.push_back(overlap[k]);
    curve.force.push_back(force[k]);
  }
  return curve;
}

double force_at(const ForceCurve& curve, double overlap) {
  const auto after = std::ranges::lower_bound(curve.overlap, overlap);
  if (after == curve.overlap.begin()) return curve.force.front();
  if (after == curve.overlap.end()) return curve.force.back();
  const std::size_t k = after - curve.overlap.begin();
  const double share = (overlap - curve.overlap[k - 1]) / (curve.overlap[k] - curve.overlap[k - 1]);
  return curve.force[k - 1] + share * (curve.force[k] - curve.force[k - 1]);
}

double find_last_rise(std::span<const double> history, double value) {
  for (std::size_t k = history.size(); k-- > 1;)
    if (history[k - 1] <= value && value < history[k])
      return static_cast<double>(k) - (history[k] - value) / (history[k] - history[k - 1]);
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> common_overlaps(std::span<const ForceCurve* const> curves, double highest,
                                    int n) {
  double low = 0, high = highest;
  for (const ForceCurve* c : curves) {
    if (c->empty()) return {};
    low = std::max(low, c->overlap.front());
    high = std::min(high, c->overlap.back());
  }
  std::vector<double> out;
  if (low >= high) return out;
  for (int k = 0; k < n; ++k) out.push_back(low + (high - low) * k / (n - 1));
  return out;
}

}  // namespace acinus::calibration
