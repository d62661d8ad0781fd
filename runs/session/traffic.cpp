#include "runs/session/traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace acinus::runs {

std::vector<std::string> describe_traffic(const Ranks& ranks, std::int64_t steps, double wall_s) {
  std::vector<std::string> lines;
  if (ranks.is_alone()) return lines;
  const Traffic own = Ranks::traffic();
  std::vector<Traffic> all;
  ranks.gather<Traffic>(std::span(&own, 1), all);
  const double per_step = 1 / static_cast<double>(std::max<std::int64_t>(steps, 1));
  constexpr double kKilo = 1000;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Traffic& t = all[r];
    const auto count = [&](std::int64_t n) { return static_cast<double>(n) * per_step; };
    lines.push_back(
        fmt::format("process {:3d}: per step {:.1f} messages of {:.1f} KB together, {:.1f} "
                    "reductions of {:.1f} "
                    "KB, {:.1f} gatherings of {:.1f} KB; {:.0f} % of the time in them",
                    r, count(t.messages), count(t.message_bytes) / kKilo, count(t.reductions),
                    count(t.reduction_bytes) / kKilo, count(t.gatherings),
                    count(t.gathered_bytes) / kKilo, 100 * t.wait_s / wall_s));
  }
  return lines;
}

}  // namespace acinus::runs
