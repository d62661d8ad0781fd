#include "substances/planes.hpp"

#include "core/numbers/lanes.hpp"

namespace acinus::substances {
namespace {

/// Sum of f(lanes at i), the rest number by number.
template <class InLanes, class Single>
ACINUS_INLINE double sum_in_lanes(std::size_t n, const InLanes& in_lanes, const Single& single) {
  Lane even = lane_of(0), odd = lane_of(0);
  std::size_t i = 0;
  for (; i + 2 * kLanes <= n; i += 2 * kLanes) {
    even += in_lanes(i);
    odd += in_lanes(i + kLanes);
  }
  double sum = sum_lanes<double>(even + odd);
  for (; i < n; ++i) sum += single(i);
  return sum;
}

ACINUS_KERNEL double sum_of(const double* a, std::size_t n) {
  return sum_in_lanes(
      n, [a](std::size_t i) { return load(a + i); }, [a](std::size_t i) { return a[i]; });
}
ACINUS_KERNEL double dot_of(const double* a, const double* b, std::size_t n) {
  return sum_in_lanes(
      n, [a, b](std::size_t i) { return load(a + i) * load(b + i); },
      [a, b](std::size_t i) { return a[i] * b[i]; });
}

}  // namespace

double sum_numbers(std::span<const double> a) { return sum_of(a.data(), a.size()); }
double dot_numbers(std::span<const double> a, std::span<const double> b) {
  return dot_of(a.data(), b.data(), a.size());
}

}  // namespace acinus::substances
