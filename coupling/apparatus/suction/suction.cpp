#include "coupling/apparatus/suction/suction.hpp"

#include "dcm/loads/loads.hpp"

namespace acinus::coupling {

SuctionLoad Suction::load_at(double time) const {
  return {mouth, axis, reach, pressure.entry.empty() ? 0 : pressure.at(time)};
}

double Suction::next_change(double time) const { return pressure.next(time); }

void Suction::add_loads(double time, const LoadedCells& cells, std::span<solve::RankOne>) const {
  const SuctionLoad load = load_at(time);
  if (!(load.pressure > 0)) return;
  dcm::for_each_loaded_group(cells.state, cells.lanes, cells.system, [&](const dcm::GroupView& g) {
    add_suction_load(g, load, cells.system);
  });
}

}  // namespace acinus::coupling
