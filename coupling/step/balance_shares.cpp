#include "coupling/step/balance_shares.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "core/parallel/clock.hpp"
#include "coupling/step/sharing.hpp"
#include "coupling/step/workspace_size.hpp"

namespace acinus::coupling {
namespace {

/// Accepted steps between checks of the load, and the largest accepted load imbalance.
constexpr std::int64_t kStepsBetween = 32;
constexpr double kImbalance = 1.1;

/// Busy time of this process since its start, s.
double busy_time() { return wall_seconds() - Ranks::traffic().wait_s; }

/// Relative costs of own blocks without a measurement: their points and the contacts of these.
/// @return [n_block], of own blocks
RowVector<double> count_work(const solve::System& s) {
  constexpr double kLinkWork = 2;  // points
  auto work = make_zeros<double>(s.block.size());
  for (const auto& [first, last] : s.own)
    for (std::size_t b = first; b < last; ++b)
      work[b] = static_cast<double>(kLanes * (s.row_of(b + 1) - s.row_of(b)));
  const auto add = [&](solve::Point p) {
    if (s.owns(p)) work[s.block_of(p)] += kLinkWork;
  };
  for (const solve::Link& l : s.links.link) {
    add(l.a.point[0]);
    if (l.b.exists()) add(l.b.point[0]);
  }
  return work;
}

}  // namespace

void balance_shares(World& world, Workspace& w) {
  const solve::Ownership& ownership = w.system.ownership;
  MeasuredCost& cost = w.cost;
  if (ownership.is_whole() || ++cost.steps < kStepsBetween) return;
  const double busy = busy_time() - cost.busy;
  const bool first = cost.busy == 0;
  const double steps = static_cast<double>(cost.steps);
  cost.busy += busy;
  cost.steps = 0;
  if (first) return;  // with reading and placing
  // The busy time of each process is distributed over its blocks by their work.
  const RowVector<double> work = count_work(w.system);
  double own_work = 0;
  for (const auto& [begin, end] : w.system.own)
    for (std::size_t b = begin; b < end; ++b) own_work += work[b];
  const State& s = world.state;
  cost.of_cell.clear();
  for (const auto& [begin, end] : w.system.own)
    for (std::size_t b = begin; b < end; ++b) {
      std::size_t n = 0;
      for_each_cell_of(s, b, [&](std::int64_t, std::size_t) { ++n; });
      for_each_cell_of(s, b, [&](std::int64_t lineage, std::size_t) {
        cost.of_cell.emplace_back(lineage,
                                  busy / steps * work[b] / own_work / static_cast<double>(n));
      });
    }
  std::ranges::sort(cost.of_cell);
  std::vector<double> times;
  ownership.ranks.gather<double>(std::span(&busy, 1), times);
  double sum = 0;
  for (const double t : times) sum += t;
  const double most = *std::ranges::max_element(times);
  if (world.sharing == Sharing::kBalanced &&
      most * static_cast<double>(times.size()) > kImbalance * sum)
    size_workspace(world, w);
}

}  // namespace acinus::coupling
