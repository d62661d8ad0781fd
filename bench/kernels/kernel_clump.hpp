#pragma once
/// Subject of the kernel benchmarks: a packed clump of deformable cells in the middle of a run.

#include <benchmark/benchmark.h>

#include "bench/step/packed_clump.hpp"

namespace acinus::bench {

/// The clump of so many cells of 162 nodes with three-point quadrature; made once, then the same
/// for all. Benchmarks that write to a part of it take a copy of that part.
const AssembledClump& packed_clump(int n_cell);

/// Runs a benchmark on clumps that fit a second-level cache and that do not.
inline void clump_sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("cells")->Arg(8)->Arg(64)->Unit(benchmark::kMicrosecond);
}

/// Reports how many things one iteration works on and, as a rate, how many a second.
inline void count(benchmark::State& state, const char* what, std::size_t n) {
  state.counters[what] = static_cast<double>(n);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

}  // namespace acinus::bench
