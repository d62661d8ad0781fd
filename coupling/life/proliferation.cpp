#include "coupling/life/proliferation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/numbers/random.hpp"
#include "core/numbers/time_grid.hpp"

namespace acinus::coupling {
namespace {

double axis_distance(const Proliferation& p, const Vec3& x) {
  return std::hypot(x.x() - p.axis_point.x(), x.y() - p.axis_point.y());
}

/// Present rate of entry into the cycle in a layer, 1/s.
double entry_rate(const Proliferation& p, int layer, double time) {
  double sum = 0;
  for (const EntryRate& r : p.rate)
    if (layer >= r.first_layer && layer <= r.last_layer && time >= r.from && time < r.until)
      sum += r.rate;
  return sum;
}

}  // namespace

int layer_of(double distance, double edge, double thickness) {
  return 1 + std::max(0, static_cast<int>(std::floor((distance - edge) / thickness)));
}

int layer_of(const Proliferation& rule, double edge, const Vec3& place) {
  return layer_of(axis_distance(rule, place), edge, rule.thickness);
}

double lesion_edge(const World& world) {
  const Proliferation& p = *world.params.life.proliferation;
  if (p.edge_at_start) return p.start_edge;
  std::map<int, double> nearest;  // by slice of height
  for_each_cell(world.state, [&](const Cell& c) {
    const Vec3 x = center_of(world.state, c);
    const auto slice = static_cast<int>(std::floor((x.z() - p.axis_point.z()) / p.thickness));
    const auto [at, added] = nearest.try_emplace(slice, std::numeric_limits<double>::infinity());
    at->second = std::min(at->second, axis_distance(p, x));
  });
  double sum = 0;
  for (const auto& [slice, distance] : nearest) sum += distance;
  return nearest.empty() ? 0 : sum / static_cast<double>(nearest.size());
}

void let_proliferate(World& world, std::span<const double> factor) {
  State& s = world.state;
  const LifeParams& life = world.params.life;
  const Proliferation& p = *life.proliferation;
  std::vector<Cell> resting;
  int growing = 0;
  for_each_cell(s, [&](const Cell& c) {
    const Cycle& cycle = s.cycle[c.index];
    if (cycle.fate == Fate::kQuiescent && cycle.duration > 0) resting.push_back(c);
    if (cycle.fate == Fate::kGrow || cycle.fate == Fate::kRest) ++growing;
  });
  int free = p.cells > 0 ? p.cells - count_cells(s) - growing : std::numeric_limits<int>::max();
  if (free <= 0 || resting.empty()) return;
  std::ranges::sort(resting, {}, [&](const Cell& c) { return lineage_of(s, c); });
  const double edge = lesion_edge(world), time = time_of(s);
  const auto interval = static_cast<std::uint64_t>(grid_interval(time, life.grid));
  for (const Cell& c : resting) {
    if (free <= 0) return;
    const int layer = layer_of(p, edge, center_of(s, c));
    const double rate = factor[c.index] * entry_rate(p, layer, time);
    if (rate <= 0) continue;
    const double drawn = uniform({life.seed, Purpose::kProliferation,
                                  static_cast<std::uint64_t>(lineage_of(s, c)), interval, 0});
    if (drawn >= -std::expm1(-rate * life.grid)) continue;
    s.cycle[c.index].fate = Fate::kGrow;
    --free;
  }
}

}  // namespace acinus::coupling
