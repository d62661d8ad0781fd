#pragma once
/// Sums over all cells, independent of the number of threads and processes.

#include <array>
#include <cstddef>
#include <vector>

#include "core/numbers/exact_sum.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Calls f(lane, address of the first point, number of places, part) for every own body, with one
/// part per block, then put(part) in the order of the blocks. Cells that do not move with the step,
/// constrained and late ones, are left out on request.
template <class Part, class F, class Put>
void for_each_own_cell(const Workspace& w, bool moving_only, const F& f, const Put& put) {
  // Kept per calling thread to reuse memory; other threads of the loop write to the parts.
  thread_local std::vector<Part> kept_part;
  std::vector<Part>& part = kept_part;
  const solve::Blocks& block = w.system.block;
  part.assign(w.system.n_own(), Part{});
  solve::for_each_own_block(w.system, [&](std::size_t k, std::size_t b) {
    for (int l = 0; l < kLanes; ++l) {
      const std::size_t lane = b * kLanes + static_cast<std::size_t>(l);
      const bool moves = !w.constraint.holds(lane) && !w.is_late(lane);
      if (w.active[lane] && (moves || !moving_only))
        f(lane, make_address(block[b].first_row, l), block[b].pattern->count_places(), part[k]);
    }
  });
  for (const Part& p : part) put(p);
}

/// Sums of N numbers over the cells, and the largest of one number.
template <std::size_t N>
struct CellSums {
  std::array<double, N> number{};
  double largest = 0;
};

/// Exact sums over the cells of all processes.
template <std::size_t N, class F>
CellSums<N> sum_over_cells(const Workspace& w, bool moving_only, const F& f) {
  std::array<ExactSum, N> sum;
  CellSums<N> total;
  for_each_own_cell<CellSums<N>>(w, moving_only, f, [&](const CellSums<N>& part) {
    for (std::size_t n = 0; n < N; ++n) sum[n].add(part.number[n]);
    total.largest = std::max(total.largest, part.largest);
  });
  const Ranks& ranks = w.system.ownership.ranks;
  ranks.sum(sum);
  for (std::size_t n = 0; n < N; ++n) total.number[n] = sum[n].value();
  total.largest = ranks.max(total.largest);
  return total;
}

}  // namespace acinus::coupling
