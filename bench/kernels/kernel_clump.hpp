#pragma once
/// Input of the kernel benchmarks: a packed clump of deformable cells during a run.

#include <benchmark/benchmark.h>

#include "bench/step/packed_clump.hpp"

namespace acinus::bench {

/// Clump of n_cell cells of 162 nodes with three-point quadrature, made once. Benchmarks that write
/// to a part of it copy that part.
const AssembledClump& packed_clump(int n_cell);

/// Applies the sizes of clumps that fit a second-level cache and that do not.
inline void clump_sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("cells")->Arg(8)->Arg(64)->Unit(benchmark::kMicrosecond);
}

/// Reports the number of items per iteration and their rate, 1/s.
inline void count(benchmark::State& state, const char* what, std::size_t n) {
  state.counters[what] = static_cast<double>(n);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

}  // namespace acinus::bench
