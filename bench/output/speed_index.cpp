#include "bench/output/speed_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/parallel/clock.hpp"

namespace acinus::bench {

double measure_speed_index() {
  constexpr std::size_t kSize = 32000;
  constexpr int kSweeps = 20;
  std::vector<double> x(kSize, 1.0), y(kSize, 0.0);
  std::array<double, 9> time{};
  double kept = 0;
  for (double& t : time) {
    const double start = cpu_seconds();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      // A root, so that the work is bound neither by memory nor by additions alone.
      for (std::size_t k = 1; k + 1 < kSize; ++k)
        y[k] = 0.5 * std::sqrt(x[k - 1] * x[k + 1]) + 0.5 * x[k];
      std::swap(x, y);
    }
    t = 1e3 * (cpu_seconds() - start);
    kept += x[kSize / 2];
  }
  std::ranges::sort(time);
  // The sum is used, so that no compiler removes the loop.
  return std::isfinite(kept) ? time[time.size() / 2] : 0;
}

}  // namespace acinus::bench
