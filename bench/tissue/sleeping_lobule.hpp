#pragma once
/// Speed-up by the sleep of resting cells, and its error in the pressures.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Benchmark: shipped lobule with resting cells, from its settled state with and without sleep.
BenchTable bench_sleep(const BenchOptions& options);

}  // namespace acinus::bench
