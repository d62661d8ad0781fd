#include "coupling/apparatus/apparatus.hpp"

#include <algorithm>
#include <limits>

namespace acinus::coupling {

void Apparatus::remove_drives() {
  std::erase_if(devices_, [](const auto& device) { return !device->acts_at_rest(); });
}

double Apparatus::next_change(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& device : devices_) next = std::min(next, device->next_change(time));
  return next;
}

void Apparatus::set_params(double time, std::span<dcm::Params> types) const {
  for (const auto& device : devices_) device->set_params(time, types);
}

void Apparatus::add_cell_forces(double time, const ForcedCells& cells) const {
  for (const auto& device : devices_) device->add_cell_forces(time, cells);
}

void Apparatus::add_loads(double time, const LoadedCells& cells) const {
  std::span<solve::RankOne> family = std::span(cells.system.rank_one).last(count_rank_one());
  for (const auto& device : devices_) {
    const std::size_t n = device->count_rank_one();
    device->add_loads(time, cells, family.first(n));
    family = family.subspan(n);
  }
}

std::size_t Apparatus::count_rank_one() const {
  std::size_t n = 0;
  for (const auto& device : devices_) n += device->count_rank_one();
  return n;
}

}  // namespace acinus::coupling
