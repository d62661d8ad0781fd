#include "cbm/state.hpp"

#include <algorithm>
#include <map>

#include "core/sphere.hpp"
#include "core/threads.hpp"

namespace acinus::cbm {

State make_state(const std::vector<NewCell>& cells) {
  State s;
  s.position.assign((cells.size() + kLanes - 1) / kLanes * kPointStride, 0.0);
  s.lineage.reserve(cells.size());
  s.type.reserve(cells.size());
  s.volume.reserve(cells.size());
  s.strength.reserve(cells.size());
  s.young.reserve(cells.size());
  s.pull.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    store_point(s.position.data(), cell_address(0, c), cells[c].center);
    s.lineage.push_back(cells[c].lineage);
    s.type.push_back(cells[c].type);
    s.volume.push_back(Ramp::constant(sphere_volume(cells[c].radius)));
    s.strength.push_back(cells[c].strength);
    s.young.push_back(cells[c].young);
    s.pull.push_back(cells[c].pull);
  }
  return s;
}

State compose(std::span<const CellRef> cells) {
  State s;
  s.position.assign((cells.size() + kLanes - 1) / kLanes * kPointStride, 0.0);
  std::map<const State*, std::vector<int>> new_index;  // [cell of that state], -1: left out
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto& [from, cell, type] = cells[k];
    store_point(s.position.data(), cell_address(0, k), center_of(*from, cell));
    s.lineage.push_back(from->lineage[cell]);
    s.type.push_back(type < 0 ? from->type[cell] : type);
    s.volume.push_back(from->volume[cell]);
    s.young.push_back(from->young[cell]);
    s.strength.push_back(from->strength[cell]);
    s.pull.push_back(from->pull[cell]);
    auto& index = new_index.try_emplace(from, from->n_cell(), -1).first->second;
    index[cell] = static_cast<int>(k);
  }
  for (const auto& [from, index] : new_index)
    for (const auto& [a, b] : from->touching) {
      const int i = index[a];
      const int j = b < 0 ? b : index[b];
      if (i < 0 || (b >= 0 && j < 0)) continue;
      s.touching.emplace_back(b < 0 ? i : std::min(i, j), b < 0 ? b : std::max(i, j));
    }
  std::ranges::sort(s.touching);
  return s;
}

std::vector<double> radii_at(const State& s, double time) {
  std::vector<double> radius;
  find_radii(s, time, radius);
  return radius;
}

void find_radii(const State& s, double time, std::vector<double>& radius) {
  radius.resize(s.n_cell());
  for_each_index(radius.size(), worth_threads(s.n_row()),
                 [&](std::size_t c) { radius[c] = sphere_radius(s.volume[c].at(time)); });
}

std::vector<double> strengths_at(const State& s, double time) {
  std::vector<double> strength;
  find_strengths(s, time, strength);
  return strength;
}

void find_strengths(const State& s, double time, std::vector<double>& strength) {
  strength.clear();
  if (std::ranges::all_of(s.strength, [&](const Ramp& r) { return r.at(time) == 1; })) return;
  for (std::size_t c = 0; c < s.n_cell(); ++c) strength.push_back(s.strength[c].at(time));
}

std::vector<solve::Block> make_blocks(const State& s) {
  static const solve::BlockPattern kSinglePoint{1, {}, {}, {}};
  solve::Block block;
  block.pattern = &kSinglePoint;
  return std::vector<solve::Block>(s.n_row(), block);
}

}  // namespace acinus::cbm
