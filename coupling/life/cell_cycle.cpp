#include "coupling/life/cell_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers/hill.hpp"
#include "core/numbers/random.hpp"

namespace acinus::coupling {

double draw_cycle_time(const CycleParams& p, std::uint64_t seed, std::int64_t lineage) {
  return truncated_normal({seed, Purpose::kCycleTime, static_cast<std::uint64_t>(lineage), 0, 0},
                          p.time, p.spread * p.time, 3);
}

double draw_start_age(const CycleParams& p, std::uint64_t seed, std::int64_t lineage) {
  if (!p.random_start) return 0;
  return uniform({seed, Purpose::kCycleTime, static_cast<std::uint64_t>(lineage), 1, 0});
}

Ramp growth_from(const Cycle& c, double volume_now, double time, double factor) {
  const double to = 2 * c.birth_volume;
  const double rate = factor * c.birth_volume / c.duration;
  if (!(rate > 0) || volume_now >= to) return Ramp::constant(std::min(volume_now, to));
  return {volume_now, to, time, time + (to - volume_now) / rate};
}

double growth_factor(const Inhibition& p, const Crowding& now) {
  const auto falls = [&](double x) {
    return 1 / (1 + std::pow(std::max(x, 0.0) / p.threshold, p.power));
  };
  switch (p.by) {
    case InhibitedBy::kNothing:
      return 1;
    case InhibitedBy::kPressure:
      return falls(now.pressure);
    case InhibitedBy::kDensity:
      return falls(now.density);
    case InhibitedBy::kVolume:
      return hill(now.relative_volume, p.threshold, p.power);
  }
  return 1;
}

}  // namespace acinus::coupling
