#pragma once
/// Sums over all cells that are the same for any number of threads.

#include <cstddef>
#include <vector>

#include "core/threads.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Point rows that one part of a sum covers at least.
constexpr std::size_t kPartRows = 64;

/// f(lane, address of its first point, number of points, part) for every cell; the parts are added
/// up in order; without constrained cells, or of all. Parts follow from the blocks alone, so the
/// sum is the same for any number of threads.
template <class Part, class F>
Part sum_over_cells(const Workspace& w, bool unconstrained_only, F f) {
  const auto& block = w.system.block;
  // Of this thread, so that their memory stays; other threads of the loop write to them.
  thread_local std::vector<std::size_t> kept_start;
  thread_local std::vector<Part> kept_part;
  std::vector<std::size_t>& start = kept_start;
  std::vector<Part>& part = kept_part;
  start.assign(1, 0);
  for (std::size_t b = 0; b < block.size(); ++b)
    if (block[b].first_row - block[start.back()].first_row >= kPartRows) start.push_back(b);
  start.push_back(block.size());
  part.assign(start.size() - 1, {});
  for_each_index(part.size(), worth_threads(w.system.n_row), [&](std::size_t k) {
    for (std::size_t b = start[k]; b < start[k + 1]; ++b)
      for (int l = 0; l < kLanes; ++l) {
        const std::size_t lane = b * kLanes + l;
        if (w.active[lane] && !(unconstrained_only && w.constraint.holds(lane)))
          f(lane, make_address(block[b].first_row, l), block[b].pattern->n_point, part[k]);
      }
  });
  Part total;
  for (const Part& p : part) total.add(p);
  return total;
}

}  // namespace acinus::coupling
