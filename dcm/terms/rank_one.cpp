#include "dcm/terms/rank_one.hpp"

#include <cmath>

namespace acinus::dcm {
namespace {

/// Units of a component of eight lanes: powers of two, of which its largest number has less than
/// 2^24 even after rounding up, as many as a float counts.
struct Units {
  Lane unit, per_unit;
};
Units find_units(const Lane& most) {
  constexpr double kLeast = 1e-30;  // below it all are zero
  Units u{lane_of(1), lane_of(1)};
  for (int l = 0; l < kLanes; ++l) {
    if (!(most[l] > kLeast) || !std::isfinite(most[l])) continue;
    u.unit[l] = std::ldexp(1.0, std::ilogb(most[l] * (1 + 1e-6)) - 23);
    u.per_unit[l] = 1 / u.unit[l];
  }
  return u;
}

/// Subtracts `excess` units from one component of a lane, one each from numbers that were rounded
/// up by much, or that were rounded down by much if it is negative.
void subtract_excess(int n_node, double excess, double unit, const double* gradient, float* to) {
  const double sign = excess > 0 ? 1 : -1;
  for (const double share : {0.4, 0.2, -0.5})
    for (int i = 0; i < n_node && excess != 0; ++i) {
      const double kept = static_cast<double>(to[i * kPointStride]);
      if (!(sign * (kept - gradient[i * kPointStride]) > share * unit)) continue;
      to[i * kPointStride] = static_cast<float>(kept - sign * unit);
      excess -= sign;
    }
}

}  // namespace

ACINUS_KERNEL void round_gradient(int n_node, const double* gradient, float* to) {
  // Of a double as large as this the last bit is 1: adding it rounds to the nearest integer.
  constexpr double kInteger = 6755399441055744.0;  // 1.5 * 2^52
  for (int c = 0; c < kPointStride; c += kLanes) {
    Lane most = lane_of(0);
    for (int i = 0; i < n_node; ++i) {
      const Lane g = load(gradient + i * kPointStride + c), size = g < 0.0 ? -g : g;
      most = size > most ? size : most;
    }
    const auto [unit, per_unit] = find_units(most);
    Lane excess = lane_of(0);
    for (int i = 0; i < n_node; ++i) {
      const Lane whole = (per_unit * load(gradient + i * kPointStride + c) + kInteger) - kInteger;
      store(to + i * kPointStride + c, unit * whole);
      excess += whole;
    }
    for (int l = 0; l < kLanes; ++l)
      subtract_excess(n_node, excess[l], unit[l], gradient + c + l, to + c + l);
  }
}

}  // namespace acinus::dcm
