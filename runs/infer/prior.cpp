#include "runs/infer/prior.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::runs {

double Prior::density(double x) const {
  if (x < low || x > high) return 0;
  if (!normal) return 1;
  const double z = (x - mean) / sd;
  return std::exp(-0.5 * z * z);
}

double Prior::draw(UniformStream& random) const {
  if (!normal) return random.uniform(low, high);
  for (;;) {
    const double x = mean + sd * random.normal();
    if (density(x) > 0) return x;
  }
}

double Prior::step(int k, int n) const {
  constexpr double kReach = 3;
  const double from = normal ? std::max(low, mean - kReach * sd) : low;
  const double to = normal ? std::min(high, mean + kReach * sd) : high;
  return n < 2 ? 0.5 * (from + to) : from + (to - from) * k / (n - 1);
}

double Prior::value(double x) const { return log ? std::exp(x) : x; }

double Prior::coordinate(double v) const { return log ? std::log(v) : v; }

}  // namespace acinus::runs
