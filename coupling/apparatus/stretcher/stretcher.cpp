#include "coupling/apparatus/stretcher/stretcher.hpp"

#include <algorithm>
#include <limits>

#include "dcm/loads/loads.hpp"

namespace acinus::coupling {

StretchLoad Stretcher::load_at(double time) const {
  const bool shines =
      std::ranges::any_of(pulse, [time](const Pulse& p) { return p.from <= time && time < p.to; });
  return {axis.normalized(), exponent, shines ? stress_amplitude(beams) : 0};
}

double Stretcher::next_change(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Pulse& p : pulse)
    for (const double moment : {p.from, p.to})
      if (moment > time) next = std::min(next, moment);
  return next;
}

void Stretcher::add_loads(double time, const LoadedCells& cells, std::span<solve::RankOne>) const {
  const StretchLoad load = load_at(time);
  if (!(load.stress > 0)) return;
  dcm::for_each_loaded_group(cells.state, cells.lanes, cells.system, [&](const dcm::GroupView& g) {
    add_stretch_load(g, load, cells.system);
  });
}

}  // namespace acinus::coupling
