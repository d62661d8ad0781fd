#include "cbm/state.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"

namespace acinus::cbm {

namespace {

State make_size(std::size_t n) {
  State s;
  s.position = make_zeros<double>((n + kLanes - 1) / kLanes * kPointStride);
  s.lineage.resize(n);
  s.volume = make_zeros<Ramp>(n);
  return s;
}

/// Touching pairs among cells of other states, by their new numbers, ascending.
std::vector<std::pair<int, int>> find_touching(std::span<const SelectedCell<State>> cells) {
  std::map<const State*, std::vector<int>> new_index;  // [cell of that state], -1: left out
  for (std::size_t k = 0; k < cells.size(); ++k)
    new_index.try_emplace(cells[k].state, cells[k].state->n_cell(), -1)
        .first->second[cells[k].index] = static_cast<int>(k);
  const auto for_each_pair = [&](const auto& f) {
    for (const auto& [from, index] : new_index)
      for (const auto& [a, b] : from->touching) {
        const int i = index[a];
        const int j = b < 0 ? b : index[b];
        if (i >= 0 && (b < 0 || j >= 0)) f(b < 0 ? i : std::min(i, j), b < 0 ? b : std::max(i, j));
      }
  };
  // Sorted by their first cells in one pass; each has few.
  std::vector<std::size_t> next(cells.size() + 1, 0);
  for_each_pair([&](int a, int) { ++next[a + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<std::size_t> start = next;
  std::vector<std::pair<int, int>> pairs(next.back());
  for_each_pair([&](int a, int b) { pairs[next[a]++] = {a, b}; });
  const auto at = [&](std::size_t k) { return pairs.begin() + static_cast<std::ptrdiff_t>(k); };
  for_each_index(cells.size(), worth_threads(cells.size() / kLanes),
                 [&](std::size_t k) { std::sort(at(start[k]), at(start[k + 1])); });
  return pairs;
}

}  // namespace

State make_state(const std::vector<NewCell>& cells) {
  State s = make_size(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    store_point(s.position.data(), cell_address(0, c), cells[c].center);
    s.lineage[c] = cells[c].lineage;
    s.volume[c] = Ramp::constant(sphere_volume(cells[c].radius));
  }
  const std::size_t n = cells.size();
  s.type = {n, [&](std::size_t c) { return cells[c].type; }};
  s.strength = {n, [&](std::size_t c) { return cells[c].strength; }};
  s.young = {n, [&](std::size_t c) { return cells[c].young; }};
  s.pull = {n, [&](std::size_t c) { return cells[c].pull; }};
  return s;
}

State compose(std::span<const SelectedCell<State>> cells, std::span<const std::uint8_t> absent) {
  State s = make_size(cells.size());
  for_each_index(cells.size(), worth_threads(s.n_row()), [&](std::size_t k) {
    const State* const from = cells[k].state;
    const std::size_t cell = cells[k].index;
    s.lineage[k] = from->lineage[cell];
    if (!absent.empty() && absent[k] != 0) return;
    store_point(s.position.data(), cell_address(0, k), center_of(*from, cell));
    s.volume[k] = from->volume[cell];
  });
  const auto copy = [&](auto State::*values) {
    s.*values = {cells.size(),
                 [&](std::size_t k) { return (cells[k].state->*values)[cells[k].index]; }};
  };
  copy(&State::strength);
  copy(&State::young);
  copy(&State::pull);
  s.type = {cells.size(), [&](std::size_t k) {
              const auto& [from, cell, type] = cells[k];
              return type < 0 ? from->type[cell] : type;
            }};
  s.touching = find_touching(cells);
  return s;
}

std::vector<double> radii_at(const State& s, double time) {
  std::vector<double> radius(s.n_cell());
  for_each_index(radius.size(), worth_threads(s.n_row()),
                 [&](std::size_t c) { radius[c] = sphere_radius(s.volume[c].at(time)); });
  return radius;
}

std::vector<double> strengths_at(const State& s, double time) {
  std::vector<double> strength;
  if (std::ranges::all_of(s.strength, [&](const Ramp& r) { return r.at(time) == 1; }))
    return strength;
  for (const Ramp& r : s.strength) strength.push_back(r.at(time));
  return strength;
}

void append_blocks(const State& s, solve::Blocks& blocks) {
  static const solve::BlockPattern kSinglePoint{1, {}, {}, {}};
  blocks.append_points(kSinglePoint, s.n_row());
}

}  // namespace acinus::cbm
