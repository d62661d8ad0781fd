#pragma once
/// Cost of nuclei.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Ratio of the CPU time per step of 27 growing cells with and without nuclei, timed in turns.
BenchTable bench_nucleus(const BenchOptions& options);

}  // namespace acinus::bench
