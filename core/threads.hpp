#pragma once
/// When work is worth more than one thread.

#include <omp.h>

#include <cstddef>

#include "core/lanes.hpp"

namespace acinus {

/// Below this many point rows (a deformable cell's group has one per node) starting threads costs
/// more than it saves.
inline bool worth_threads(std::size_t n_row) { return n_row > 400; }

/// Threads that work on so many point rows; 1 inside a parallel region.
inline std::size_t count_threads(std::size_t n_row) {
  return worth_threads(n_row) && !omp_in_parallel()
             ? static_cast<std::size_t>(omp_get_max_threads())
             : 1;
}

/// f(k) for all k < n: numbers of vectors over all points, three lanes of them to a row.
template <class F>
void for_each_number(std::size_t n, F f) {
#pragma omp parallel for schedule(static) if (count_threads(n / kPointStride) > 1)
  for (std::size_t k = 0; k < n; ++k) f(k);
}

}  // namespace acinus
