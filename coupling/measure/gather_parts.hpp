#pragma once
/// Gathering of values of cells at the root, some cells at a time.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "coupling/measure/cell_numbers.hpp"

namespace acinus::coupling {

/// Gathers values of the deformable cells at the root in the order of their numbers, about 2 MB at
/// a time. Collective.
/// @param count  count(k): number of values of cell k
/// @param pack   pack(k, values): appends those of an own cell
/// @param take   take(values): of the next cells; at the root only
template <class T, class Count, class Pack, class Take>
void gather_parts(const Ranks& ranks, const CellNumbers& numbers, const Workspace& w,
                  const Count& count, const Pack& pack, const Take& take) {
  constexpr std::size_t kMostBytes = 2 << 20;
  const bool alone = w.system.ownership.is_whole();
  if (alone && !ranks.is_root()) return;
  const std::size_t n = numbers.lane.size();
  std::vector<T> own, by_rank, values;
  std::vector<std::size_t> next;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    own.clear();
    std::size_t n_here = 0;
    do {
      n_here += count(last);
      if (is_own_number(numbers, w, last)) pack(last, own);
    } while (++last < n && (n_here + count(last)) * sizeof(T) <= kMostBytes);
    if (alone) {
      take(std::span<const T>(own));
      continue;
    }
    ranks.gather_at_root<T>(own, by_rank, &next);
    if (!ranks.is_root()) continue;
    values.clear();
    for (std::size_t k = first; k < last; ++k) {
      std::size_t& from = next[static_cast<std::size_t>(owner_of_number(numbers, w, k))];
      const auto begin = by_rank.begin() + static_cast<std::ptrdiff_t>(from);
      from += count(k);
      values.insert(values.end(), begin, by_rank.begin() + static_cast<std::ptrdiff_t>(from));
    }
    take(std::span<const T>(values));
  }
}

}  // namespace acinus::coupling
