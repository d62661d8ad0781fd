#pragma once
/// What it saves that resting cells sleep, and what that does to the pressures.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// The shipped lobule with resting cells, from its settled state on with and without sleep.
BenchTable bench_sleep(const BenchOptions& options);

}  // namespace acinus::bench
