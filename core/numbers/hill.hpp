#pragma once
/// Hill function.

#include <algorithm>
#include <cmath>

namespace acinus {

/// Hill function x^n / (1 + x^n) of x = value / half; 0 for negative values.
inline double hill(double value, double half, double n) {
  const double x = std::pow(std::max(value, 0.0) / half, n);
  return std::isinf(x) ? 1 : x / (1 + x);
}

}  // namespace acinus
