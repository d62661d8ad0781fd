#pragma once
/// Time saved by the sleep of resting cells, and its effect on the pressures.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// The shipped lobule with resting cells, from its settled state on with and without sleep.
BenchTable bench_sleep(const BenchOptions& options);

}  // namespace acinus::bench
