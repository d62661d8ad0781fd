#include "coupling/apparatus/pull.hpp"

#include <algorithm>
#include <limits>

namespace acinus::coupling {

bool any_spring(const std::vector<Pull>& pulls) {
  return std::ranges::any_of(pulls, [](const Pull& p) { return p.stiffness > 0; });
}

void find_springs(const std::vector<Pull>& pulls, double time, const dcm::State& cells,
                  std::vector<dcm::PullSpring>& spring) {
  spring.assign(cells.n_lane(), {});
  for (const Pull& p : pulls) {
    if (!(p.stiffness > 0)) continue;
    const auto at = std::ranges::find(cells.lineage, p.cell);
    if (at == cells.lineage.end()) continue;
    spring[at - cells.lineage.begin()] = {p.direction, p.stiffness, spring_end(p, time)};
  }
}

double next_bend(const std::vector<Pull>& pulls, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Pull& p : pulls)
    next = std::min({next, p.force.next(time), p.displacement.next(time)});
  return next;
}

}  // namespace acinus::coupling
